#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace taut {

struct WallFace {
  std::array<double, 3> at{}, normal{};  // m; unit vector towards bodies
};

/// Input of a renderer.
struct FrameView {
  int dim = 2;
  double time = 0;                   // s
  std::span<const double> x;         // n × dim, m
  std::span<const double> diameter;  // m
  std::span<const double> value;     // in `unit`
  std::span<const double> cell;      // edge vectors, n × dim vectors, m; empty: round
  /// Three point numbers per triangle, in 3D anticlockwise from outside. `x` and `value` then belong to points; a
  /// `diameter` above 0 marks a loose particle. If empty, `x` and `value` belong to particles.
  std::span<const std::uint32_t> triangle;
  std::span<const double> outline, undeformed;  // 2D: four coordinates per segment, m
  std::span<const WallFace> walls;
  std::string_view field;  // "von Mises stress"
  std::string_view unit;
  std::string_view title;
  std::string_view method;
};

}  // namespace taut
