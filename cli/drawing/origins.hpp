#pragma once

#include <cstddef>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut::cli {

/// Initial particles in order of creation.
struct Origins {
  int dim = 2;
  std::vector<double> x0;        // n × dim, m
  std::vector<double> m;         // kg (2D: per metre of depth)
  std::vector<double> diameter;  // m
  std::vector<int> body;

  std::size_t size() const { return m.size(); }
};

Origins origins_of(const Snapshot& snapshot);
/// Throws SceneError.
Origins origins_of(const Scene& scene);

}  // namespace taut::cli
