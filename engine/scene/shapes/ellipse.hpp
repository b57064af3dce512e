#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/index.hpp"
#include "engine/scene/shapes/round_shapes.hpp"

namespace taut {

/// `holds` uses the distance to first order.
struct Ellipse final : ShapeBase {
  Point centre{}, semi_axes{1, 1, 1};

  Ellipse(const Point& centre, const Point& semi_axes) : centre(centre), semi_axes(semi_axes) {}

  Bounds bounds() const override {
    Bounds box{centre, centre};
    for (std::size_t k = 0; k < semi_axes.size(); ++k)
      box.low[k] -= semi_axes[k], box.high[k] += semi_axes[k];
    return box;
  }
  bool holds(const Point& x, int dim, double tolerance) const override {
    double squared = 0, slope = 0;  // (r/r_face)²; |½ ∇ squared|²
    for (std::size_t k = 0; k < as_index(dim); ++k) {
      const double d = (x[k] - centre[k]) / semi_axes[k];
      squared += d * d;
      slope += d * d / (semi_axes[k] * semi_axes[k]);
    }
    // distance ≈ (√squared − 1)/√(slope/squared)
    return squared - std::sqrt(squared) <= tolerance * std::sqrt(slope);
  }
  double measure(int dim) const override {
    double product = measure_of_ball(dim, 1);
    for (std::size_t k = 0; k < as_index(dim); ++k) product *= semi_axes[k];
    return product;
  }
  double extent_to_divide(int dim) const override {
    return 2 * *std::min_element(semi_axes.begin(), semi_axes.begin() + dim);
  }
  Point middle() const override { return centre; }
  Point anchor() const override { return centre; }
  void shift(std::size_t axis, double by) override { centre[axis] += by; }
  std::vector<Chain> outline(int dim, double dp) const override {
    if (dim != 2) return {};
    const auto place = [&](double angle) {
      return Point{centre[0] + semi_axes[0] * std::cos(angle), centre[1] + semi_axes[1] * std::sin(angle), 0};
    };
    constexpr double whole = 2 * std::numbers::pi, fine = 16;
    const double greatest = std::max(semi_axes[0], semi_axes[1]);
    const long steps = std::max(64L, std::lround(fine * whole * greatest / dp));
    std::vector<double> way = {0};  // m
    for (long k = 0; k < steps; ++k) {
      const double step = whole / static_cast<double>(steps), angle = static_cast<double>(k) * step;
      way.push_back(way.back() + distance_between(place(angle), place(angle + step), 2));
    }
    const long n = std::max(3L, std::lround(way.back() / dp));
    Chain chain;
    std::size_t step = 0;
    for (long k = 0; k < n; ++k) {
      const double along = way.back() * static_cast<double>(k) / static_cast<double>(n);
      while (way[step + 1] <= along) ++step;
      const double part = (along - way[step]) / (way[step + 1] - way[step]);
      chain.push_back(place(whole * (static_cast<double>(step) + part) / static_cast<double>(steps)));
    }
    return {chain};
  }
};

}  // namespace taut
