#pragma once

#include <algorithm>
#include <cmath>

#include "engine/simulation.hpp"
#include "tests/support/pressed.hpp"
#include "tests/support/scenes.hpp"

namespace taut::test {

/// Two arms on a foot. Each tip starts inwards at `speed`, in sound speeds.
inline Scene closing_arms(int dim, double dp, double gap, double height, double speed) {
  const double in = 0.5 * gap, width = 0.005, out = in + width, deep = dim == 3 ? width : 0;
  Scene scene = scene_of_shapes({Box{{-out, 0, 0}, {-in, height, deep}}}, dim, dp);
  scene.name = "closing-arms";
  Body& arms = scene.bodies[0];
  arms.shapes.push_back(Box{{in, 0, 0}, {out, height, deep}});
  arms.shapes.push_back(Box{{-out, -width, 0}, {out, 0, deep}});
  const double v = speed * ring_rubber().sound_speed();
  arms.velocity[0] = [=](const Point& x) { return x[1] < 0 ? 0 : (x[0] < 0 ? v : -v) * x[1] / height; };
  return scene;
}

/// Greatest x_i − x_j, m, of opposite particles i and j in the upper halves of the left and the right arm.
inline double penetration(const Snapshot& now, int dim, double dp, double height) {
  const auto n = static_cast<std::size_t>(dim);
  double most = -1;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now.x0[n * i] > 0 || now.x0[n * i + 1] < 0.5 * height) continue;
    for (std::size_t j = 0; j < now.size(); ++j) {
      if (now.x0[n * j] < 0 || now.x0[n * j + 1] < 0.5 * height) continue;
      double aside = 0;  // squared
      for (std::size_t k = 1; k < n; ++k) aside += std::pow(now.x[n * i + k] - now.x[n * j + k], 2);
      if (aside < dp * dp) most = std::max(most, now.x[n * i] - now.x[n * j]);
    }
  }
  return most;
}

}  // namespace taut::test
