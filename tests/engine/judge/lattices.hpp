#pragma once

#include "engine/diagnostics/balance.hpp"
#include "engine/judge/verdict.hpp"
#include "tests/support/made_snapshot.hpp"

namespace taut::test {

inline constexpr double dp = 0.1;
inline constexpr double support = 2.6 * dp;
inline constexpr bool kept = true, searched = false;  // values of `keeps_neighbors`

inline Snapshot lattice(int dim, int columns, int rows, int layers = 1) {
  std::vector<Point> places;
  for (int k = 0; k < layers; ++k) {
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) places.push_back({i * dp, j * dp, k * dp});
    }
  }
  return made_snapshot(dim, places);
}

inline Scene one_body(int dim) { return made_scene(dim, dp, {unit_bulk()}); }

inline Scene one_loaded_body() {
  Scene scene = one_body(2);
  scene.bodies[0].loads.emplace_back();
  return scene;
}

inline void part(Snapshot& now, double x, double by) {
  const auto dim = static_cast<std::size_t>(now.dim);
  for (std::size_t i = 0; i < now.size(); ++i)
    now.x[dim * i] = now.x0[dim * i] + (now.x0[dim * i] > x ? by : 0);
}

inline void observe(Judge& judge, Snapshot& now, const Scene& scene, double time) {
  now.time = time;
  judge.observe(now, balance(now, scene));
}

}  // namespace taut::test
