#pragma once

#include <optional>

#include "engine/scene/shape.hpp"

namespace taut {

/// Region inside an odd number of closed contours, 2D; no sides may cross.
class Polygon final : public ShapeBase {
 public:
  /// If `centre` is given, points are relative to it, and the lattice is symmetric about it.
  Polygon(std::vector<Chain> contours, const std::optional<Point>& centre = {});

  Bounds bounds() const override;
  bool holds(const Point& x, int dim, double tolerance) const override;
  double measure(int) const override { return area_; }
  Point middle() const override { return about_centre_ ? from_ : bounds().middle(); }
  Point anchor() const override { return about_centre_ ? from_ : bounds().low; }
  void shift(std::size_t axis, double by) override { from_[axis] += by; }
  std::vector<Chain> outline(int dim, double dp) const override;

 private:
  using Side = std::array<Point, 2>;

  std::size_t strip_of(double y) const;
  bool is_inside(const Point& x) const;

  std::vector<Chain> contours_;
  Point from_{};
  bool about_centre_;
  Bounds box_;
  double area_ = 0;  // m²
  std::vector<std::vector<Side>> strips_;
};

std::optional<Point> crossing(const std::vector<Chain>& contours);

}  // namespace taut
