#pragma once

#include <array>
#include <span>
#include <string_view>

namespace taut {

/// A rigid wall: the bodies are on the side that its normal points to.
struct WallFace {
  std::array<double, 3> at{}, normal{};  // m; of length 1
};

/// All that a renderer may know of a simulation: positions, sizes and one coloured field at one time.
/// The arrays belong to the caller and hold n particles, n × dim coordinates.
struct FrameView {
  int dim = 2;
  double time = 0;                   // s
  std::span<const double> x;         // position, particle after particle, m
  std::span<const double> diameter;  // m
  std::span<const double> value;     // the coloured field, in `unit`
  std::span<const double> cell;  // the edges of each particle's cell, n × dim vectors, m; none: it is round
  std::span<const WallFace> walls;
  std::string_view field;   // "von Mises stress"
  std::string_view unit;    // "Pa"
  std::string_view title;   // "Colliding rubber rings"
  std::string_view method;  // "enog"
};

}  // namespace taut
