#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/core/tensor.hpp"
#include "engine/error.hpp"
#include "engine/neighbors/kernels.hpp"

namespace taut {

/// Cells at least as wide as the support, with a border of empty cells.
template <int Dim>
class CellGrid {
 public:
  /// Returns the stable storage order.
  const std::vector<int>& sort(const std::vector<Vec<double, Dim>>& x, double support) {
    place(x, support);
    const int n = static_cast<int>(x.size());
    cell_.resize(n);
    order_.resize(n);
    start_.assign(cells_ + 1, 0);
    for (int i = 0; i < n; ++i) ++start_[(cell_[i] = cells_at_.cell_of(x[i])) + 1];
    for (int c = 0; c < cells_; ++c) start_[c + 1] += start_[c];
    for (int i = 0; i < n; ++i) order_[start_[cell_[i]]++] = i;
    for (int c = cells_; c > 0; --c) start_[c] = start_[c - 1];
    start_[0] = 0;
    return order_;
  }

  template <class F>
  void for_each_row(const Vec<double, Dim>& x, const F& f) const {
    view().for_each_row(x, f);
  }
  CellsView<Dim> view() const {
    CellsView<Dim> cells = cells_at_;
    cells.start = start_.data();
    return cells;
  }

 private:
  [[noreturn]] static void refuse() {
    throw NumericalError(0, 0, -1, "position",
                         "the position of a particle is not finite, or too large for the neighbour search");
  }

  /// Throws NumericalError without a time if a position has no cell.
  void place(const std::vector<Vec<double, Dim>>& x, double support) {
    Vec<double, Dim> low = x[0], high = x[0];
    constexpr double farthest = 1e300;
    for (const auto& p : x) {
      for (int k = 0; k < Dim; ++k) {
        if (!(std::abs(p[k]) <= farthest)) refuse();
        low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
      }
    }
    // wider cells limit the memory if a body flies apart
    const double most = 1000 + 8.0 * static_cast<double>(x.size());
    double& size = cells_at_.size;
    size = support;
    const auto along = [&](int k) { return std::floor((high[k] - low[k]) / size) + 4; };
    const auto count = [&] {
      double cells = 1;
      for (int k = 0; k < Dim; ++k) cells *= along(k);
      return cells;
    };
    while (count() > most) size *= 1.5;
    if (!(size < 1e5 * farthest)) refuse();      // if the support is NaN
    const double farthest_cell = 0x1p44 * size;  // there, rounding reaches 1/256 of a cell
    for (int k = 0; k < Dim; ++k)
      if (std::max(std::abs(low[k]), std::abs(high[k])) > farthest_cell) refuse();
    cells_ = 1;
    for (int k = 0; k < Dim; ++k) {
      cells_at_.origin[k] = low[k] - 1.5 * size;  // a border cell, and half a cell for rounding
      cells_at_.stride[k] = cells_;
      cells_ *= static_cast<int>(along(k));
    }
  }

  CellsView<Dim> cells_at_;
  int cells_ = 0;
  std::vector<int> start_;  // [cell] first stored particle
  std::vector<int> cell_, order_;
};

/// Neighbours of i are j[lanes · begin[i]] … j[lanes · begin[i + 1] − 1], padded with i to whole packs.
struct Neighbors {
  std::vector<int> begin;  // [n + 1] in packs
  std::vector<int> j;
  long pairs = 0;  // directed, without padding

  const int* pack(int b) const { return &j[static_cast<std::size_t>(lanes) * b]; }

  template <class Archive>
  void serialize(Archive& archive, std::size_t particles) {
    archive.rows(begin, particles, j, particles, lanes);
    archive(pairs);
  }
};

/// The order does not depend on the number of threads.
template <int Dim>
class NeighborSearch {
 public:
  /// `body` restricts the search to pairs within a body.
  void operator()(const CellGrid<Dim>& grid, const std::vector<Vec<double, Dim>>& x, double support,
                  int threads, Neighbors& out, const int* body = nullptr);

 private:
  std::array<std::vector<double>, Dim> x_;
  std::vector<int> count_;
  std::vector<std::vector<int>> found_;  // [chunk]
};

}  // namespace taut
