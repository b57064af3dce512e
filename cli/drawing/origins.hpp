#pragma once

#include <cstddef>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut::cli {

/// Initial particles of a run, in the order of creation.
struct Origins {
  int dim = 2;
  std::vector<double> x0;        // n × dim, m
  std::vector<double> m;         // kg (per metre of depth in 2D)
  std::vector<double> diameter;  // m
  std::vector<int> body;         // index into Scene::bodies

  std::size_t size() const { return m.size(); }
};

Origins origins_of(const Snapshot& snapshot);
/// Origins of the initial particles of a scene. Throws SceneError.
Origins origins_of(const Scene& scene);

}  // namespace taut::cli
