#pragma once

#include <array>
#include <span>
#include <string_view>

namespace taut {

/// A rigid wall; `normal` points to the side of the bodies.
struct WallFace {
  std::array<double, 3> at{}, normal{};  // m; unit vector
};

/// Complete input of a renderer: n particles with one coloured field at one time. The caller owns the arrays.
struct FrameView {
  int dim = 2;
  double time = 0;                   // s
  std::span<const double> x;         // positions, n × dim, m
  std::span<const double> diameter;  // m
  std::span<const double> value;     // coloured field, in `unit`
  std::span<const double> cell;      // edge vectors of cells, n × dim vectors, m; empty = round
  std::span<const WallFace> walls;
  std::string_view field;   // "von Mises stress"
  std::string_view unit;    // "Pa"
  std::string_view title;   // "Colliding rubber rings"
  std::string_view method;  // "enog"
};

}  // namespace taut
