#pragma once

#include "engine/scene/shape.hpp"

namespace taut {

struct Box final : ShapeBase {
  Point low{}, high{};  // m

  Box() = default;
  Box(const Point& low, const Point& high) : low(low), high(high) {}

  /// Rounded number of cells; dp in m.
  long cells(std::size_t axis, double dp) const;

  Bounds bounds() const override { return {low, high}; }
  bool holds(const Point& x, int dim, double tolerance) const override;
  void shift(std::size_t axis, double by) override { low[axis] += by, high[axis] += by; }
  double measure(int dim) const override;
  double extent_to_divide(int dim) const override;
  std::vector<Chain> outline(int dim, double dp) const override;
  bool operator==(const Box&) const = default;
};

}  // namespace taut
