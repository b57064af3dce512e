#pragma once

#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include "engine/scene/initial_particles.hpp"
#include "engine/scene/other_shapes.hpp"

namespace taut::test {

/// The particles of a scene as a body of given ones, each moved by up to `share` of a spacing along each axis.
inline Scene jittered(Scene scene, double share) {
  std::mt19937 random(5);
  const InitialParticles initial = make_initial_particles(scene);
  std::vector<Point> places = initial.x;
  for (int i = 0; i < initial.size(); ++i) {
    if (initial.held[i]) continue;
    for (int k = 0; k < scene.dim; ++k)
      places[i][k] += share * scene.spacing * (2 * std::generate_canonical<double, 53>(random) - 1);
  }
  scene.bodies[0].shapes = {AnyShape::of(GivenParticles(std::move(places), initial.V0, scene.dim))};
  return scene;
}

}  // namespace taut::test
