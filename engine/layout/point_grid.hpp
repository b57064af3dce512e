#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "engine/core/index.hpp"
#include "engine/core/point.hpp"

namespace taut {

/// Points in cells of side 1.
class PointGrid {
 public:
  PointGrid(std::vector<Point> points, int dim) : points_(std::move(points)), dim_(dim) {
    std::array<long, 3> high{};
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const std::array<long, 3> cell = cell_of(points_[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        low_[k] = i == 0 ? cell[k] : std::min(low_[k], cell[k]);
        high[k] = i == 0 ? cell[k] : std::max(high[k], cell[k]);
      }
    }
    std::size_t cells = 1;
    for (std::size_t k = 0; k < 3; ++k)
      number_[k] = high[k] - low_[k] + 1, cells *= static_cast<std::size_t>(number_[k]);
    begin_.resize(cells + 1);
    std::vector<std::size_t> cell;
    cell.reserve(points_.size());
    for (const Point& x : points_) ++begin_[cell.emplace_back(index_of(cell_of(x))) + 1];
    for (std::size_t c = 0; c < cells; ++c) begin_[c + 1] += begin_[c];
    order_.resize(points_.size());
    std::vector<int> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < points_.size(); ++i) order_[as_index(next[cell[i]]++)] = static_cast<int>(i);
  }

  const std::vector<Point>& points() const { return points_; }
  const Point& operator[](int i) const { return points_[as_index(i)]; }

  /// Calls visit(index, distance) for the points in cells within `rings` of the cell of x.
  template <class Visit>
  void around(const Point& x, long rings, const Visit& visit) const {
    for_each_cell(x, rings, [&](std::size_t cell, long, double) {
      for (int n = begin_[cell]; n < begin_[cell + 1]; ++n) {
        const int i = order_[as_index(n)];
        visit(i, distance_between((*this)[i], x, dim_));
      }
    });
  }

  struct Found {
    int index = -1;
    double distance = std::numeric_limits<double>::infinity();
  };
  /// The nearest point; none if all are farther than `farthest`.
  Found nearest(const Point& x, long farthest) const {
    Found best;
    double least = static_cast<double>(farthest) * static_cast<double>(farthest);
    for (long ring = 0; ring <= farthest && static_cast<double>((ring - 1) * std::abs(ring - 1)) < least;
         ++ring) {
      for_each_cell(x, ring, [&](std::size_t cell, long of, double squared) {
        if (of != ring || squared > least) return;
        for (int n = begin_[cell]; n < begin_[cell + 1]; ++n) {
          const int i = order_[as_index(n)];
          const Point& y = (*this)[i];
          double r2 = 0;
          for (std::size_t k = 0; k < 3; ++k) r2 += (y[k] - x[k]) * (y[k] - x[k]);
          if (r2 <= least && (r2 < least || best.index < 0)) least = r2, best.index = i;
        }
      });
    }
    if (best.index >= 0) best.distance = std::sqrt(least);
    return best;
  }

 private:
  /// Calls visit(cell, ring, squared distance from x to the cell).
  template <class Visit>
  void for_each_cell(const Point& x, long rings, const Visit& visit) const {
    if (points_.empty()) return;
    const std::array<long, 3> middle = cell_of(x);
    std::array<long, 3> from{}, to{};
    for (std::size_t k = 0; k < 3; ++k) {
      from[k] = std::max(low_[k], middle[k] - rings);
      to[k] = std::min(low_[k] + number_[k] - 1, middle[k] + rings);
    }
    const auto beyond = [&](std::size_t k, long cell) {
      const double at = x[k] - static_cast<double>(cell), off = std::max({0.0, -at, at - 1});
      return off * off;
    };
    for (long c = from[2]; c <= to[2]; ++c)
      for (long b = from[1]; b <= to[1]; ++b)
        for (long a = from[0]; a <= to[0]; ++a)
          visit(index_of({a, b, c}),
                std::max({std::abs(a - middle[0]), std::abs(b - middle[1]), std::abs(c - middle[2])}),
                beyond(0, a) + beyond(1, b) + beyond(2, c));
  }
  std::array<long, 3> cell_of(const Point& x) const {
    std::array<long, 3> cell{};
    for (std::size_t k = 0; k < as_index(dim_); ++k) cell[k] = static_cast<long>(std::floor(x[k]));
    return cell;
  }
  std::size_t index_of(const std::array<long, 3>& cell) const {
    return static_cast<std::size_t>(((cell[2] - low_[2]) * number_[1] + cell[1] - low_[1]) * number_[0] +
                                    cell[0] - low_[0]);
  }

  std::vector<Point> points_;
  int dim_;
  std::array<long, 3> low_{}, number_{};
  std::vector<int> begin_, order_;
};

}  // namespace taut
