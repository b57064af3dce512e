#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/index.hpp"
#include "engine/scene/contours.hpp"

namespace taut {

/// Each particle fills a square (cube) of its volume. On the outline, the volume fraction, smoothed by a cubic spline,
/// is ½.
class GivenParticles final : public ShapeBase {
 public:
  GivenParticles(std::vector<Point> places, std::vector<double> volumes, int dim)
      : places_(std::move(places)), volumes_(std::move(volumes)) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double size = std::pow(volumes_[i], 1.0 / dim);
      Bounds cell{places_[i], places_[i]};
      for (std::size_t k = 0; k < as_index(dim); ++k) cell.low[k] -= 0.5 * size, cell.high[k] += 0.5 * size;
      box_ = i == 0 ? cell : joined(box_, cell);
      volume_ += volumes_[i];
      size_ = std::max(size_, size);
    }
    for (std::size_t i = 0; i < places_.size(); ++i)
      sorted_.emplace_back(cell_of(places_[i]), static_cast<int>(i));
    std::ranges::sort(sorted_);
  }

  Bounds bounds() const override {
    Bounds box = box_;
    for (std::size_t k = 0; k < by_.size(); ++k) box.low[k] += by_[k], box.high[k] += by_[k];
    return box;
  }
  bool holds(const Point& x, int dim, double tolerance) const override {
    const Point y{x[0] - by_[0], x[1] - by_[1], x[2] - by_[2]};
    bool contained = false;
    around(y, [&](std::size_t i) {
      const double half = 0.5 * std::pow(volumes_[i], 1.0 / dim);
      bool in = true;
      for (std::size_t k = 0; k < as_index(dim); ++k)
        in = in && std::abs(y[k] - places_[i][k]) <= half + tolerance;
      contained = contained || in;
    });
    return contained;
  }
  double measure(int) const override { return volume_; }
  void shift(std::size_t axis, double by) override { by_[axis] += by; }
  std::vector<InitialSite> sites(int, double) const override {
    std::vector<InitialSite> sites;
    for (std::size_t i = 0; i < places_.size(); ++i)
      sites.push_back(
          {.x = {places_[i][0] + by_[0], places_[i][1] + by_[1], places_[i][2] + by_[2]}, .V0 = volumes_[i]});
    return sites;
  }
  std::vector<Chain> outline(int dim, double dp) const override {
    if (dim != 2) return {};
    const double half = 0.5 * 0.7 * std::numbers::pi * size_ * size_;  // ½ ∫ W dA for W(0) = 1, h = size_
    const auto is_in = [&](const Point& x) {
      const Point y{x[0] - by_[0], x[1] - by_[1], 0};
      double sum = 0;
      around(y,
             [&](std::size_t i) { sum += volumes_[i] * spline(distance_between(y, places_[i], 2) / size_); });
      return sum > half;
    };
    return evenly_spaced_contours(bounds(), is_in, dp);
  }

 private:
  static double spline(double r) {
    if (r >= 2) return 0;
    return r < 1 ? 1 - 1.5 * r * r + 0.75 * r * r * r : 0.25 * (2 - r) * (2 - r) * (2 - r);
  }
  std::array<long, 3> cell_of(const Point& x) const {
    constexpr double reach = 2;
    std::array<long, 3> cell{};
    for (std::size_t k = 0; k < cell.size(); ++k)
      cell[k] = static_cast<long>(std::floor(x[k] / (reach * size_)));
    return cell;
  }
  template <class Visit>
  void around(const Point& x, const Visit& visit) const {
    const std::array<long, 3> middle = cell_of(x);
    for (long i = -1; i <= 1; ++i) {
      for (long j = -1; j <= 1; ++j) {
        const std::array<long, 3> first{middle[0] + i, middle[1] + j, middle[2] - 1};
        const std::array<long, 3> last{first[0], first[1], middle[2] + 1};
        auto found = std::ranges::lower_bound(sorted_, std::pair(first, 0));
        for (; found != sorted_.end() && found->first <= last; ++found)
          visit(static_cast<std::size_t>(found->second));
      }
    }
  }

  std::vector<Point> places_;
  std::vector<double> volumes_;
  Point by_{};  // shift, m
  Bounds box_;
  double volume_ = 0;
  double size_ = 0;  // m
  std::vector<std::pair<std::array<long, 3>, int>> sorted_;
};

}  // namespace taut
