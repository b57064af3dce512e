#pragma once

#include <array>
#include <span>
#include <string_view>

namespace taut {

struct WallFace {
  std::array<double, 3> at{}, normal{};  // m; unit vector towards bodies
};

/// Complete input of a renderer. The caller owns the arrays.
struct FrameView {
  int dim = 2;
  double time = 0;                   // s
  std::span<const double> x;         // n × dim, m
  std::span<const double> diameter;  // m
  std::span<const double> value;     // in `unit`
  std::span<const double> cell;      // edge vectors, n × dim vectors, m; empty = round
  std::span<const WallFace> walls;
  std::string_view field;  // "von Mises stress"
  std::string_view unit;   // "Pa"
  std::string_view title;
  std::string_view method;
};

}  // namespace taut
