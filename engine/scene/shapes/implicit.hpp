#pragma once

#include "engine/core/index.hpp"
#include "engine/scene/contours.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/shapes/box.hpp"

namespace taut {

/// `holds` tests the tolerance along the axes.
struct Implicit final : ShapeBase {
  Box within;
  Expression inside;
  Point by{};  // shift, m

  Implicit(const Box& within, Expression inside) : within(within), inside(std::move(inside)) {}

  Bounds bounds() const override {
    Bounds box = within.bounds();
    for (std::size_t k = 0; k < by.size(); ++k) box.low[k] += by[k], box.high[k] += by[k];
    return box;
  }
  bool holds(const Point& x, int dim, double tolerance) const override {
    const auto is_in = [&](const Point& place, double beside) {
      Point y = place;
      for (std::size_t k = 0; k < as_index(dim); ++k) y[k] -= by[k];
      return within.holds(y, dim, beside) && inside && inside(y) != 0;
    };
    const bool in = is_in(x, tolerance);
    if (tolerance == 0 || in == (tolerance > 0)) return in;
    for (std::size_t k = 0; k < as_index(dim); ++k) {
      for (const double side : {-tolerance, tolerance}) {
        Point beside = x;
        beside[k] += side;
        if (is_in(beside, 0) == (tolerance > 0)) return tolerance > 0;
      }
    }
    return in;
  }
  double measure(int dim) const override { return within.measure(dim); }
  bool has_exact_measure() const override { return false; }
  void shift(std::size_t axis, double along) override { by[axis] += along; }
  std::vector<Chain> outline(int dim, double dp) const override {
    if (dim != 2) return {};
    const auto is_in = [&](const Point& x) { return holds(x, 2, 0); };
    return evenly_spaced_contours(bounds(), is_in, dp);
  }
};

}  // namespace taut
