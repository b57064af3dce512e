#pragma once

#include <vector>

#include "engine/simulation.hpp"

namespace taut::test {

inline Snapshot made_snapshot(int dim, const std::vector<Point>& places) {
  Snapshot now;
  now.dim = dim;
  for (const Point& place : places) now.x.insert(now.x.end(), place.begin(), place.begin() + dim);
  const std::size_t n = places.size();
  now.x0 = now.x;
  now.v.assign(now.x.size(), 0);
  now.m.assign(n, 1);
  now.rho.assign(n, 1);
  now.p.assign(n, 0);
  now.s.assign(n * (dim == 3 ? 6 : 4), 0);
  now.diameter.assign(n, 1);
  now.body.assign(n, 0);
  now.material.assign(n, 0);
  now.clamped.assign(n, 0);
  return now;
}

inline Scene made_scene(int dim, double spacing, const std::vector<Material>& materials) {
  Scene scene;
  scene.dim = dim;
  scene.spacing = spacing;
  scene.materials = materials;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    Body body;
    body.material = static_cast<int>(i);
    scene.bodies.push_back(body);
  }
  return scene;
}

/// Exactly K = 1 and G = 1.5.
inline Material unit_bulk() {
  return {.name = "soft", .density = 1, .youngs_modulus = 3, .poisson_ratio = 0};
}

}  // namespace taut::test
