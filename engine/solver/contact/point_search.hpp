#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/pack.hpp"
#include "engine/neighbors/neighbors.hpp"

namespace taut::inline TAUT_ISA {

/// Finds the pairs of points of one body that are near each other, four at a time.
template <int Dim>
class PointSearch {
 public:
  using V = Vec<double, Dim>;

  /// What does not change: where points are at the start, m, and their bodies.
  void add(const V& start, int body) {
    X_.push_back(start);
    body_.push_back(body);
  }
  int size() const { return static_cast<int>(X_.size()); }
  const std::vector<int>& bodies() const { return body_; }

  /// found(a, b) for the pairs nearer than `listed`, m, each once, of those more than `far`, m, apart at the
  /// start; how near the nearest other one is, m, up to `horizon`. `x` are the places now, whose order counts.
  template <class Found>
  double find(const std::vector<V>& x, double listed, double horizon, double far, const Found& found) {
    if (x.empty()) return horizon;
    sort_columns(x, horizon);
    const int n = size();
    double beyond2 = horizon * horizon;
    for (int p = 0; p < n; ++p) {
      grid_.for_each_row(x[order_[p]], [&](int first, int last) {
        for (int q = std::max(first, p + 1); q < last; q += lanes) {
          Pack d2{}, D2{};
          for (int k = 0; k < Dim; ++k) {
            const Pack d = load(&now_[k][q]) - now_[k][p], D = load(&start_[k][q]) - start_[k][p];
            d2 += d * d, D2 += D * D;
          }
          const unsigned in_row = (1u << std::min(last - q, lanes)) - 1;
          const Pack body = load(&of_body_[q]);
          unsigned near = in_row & lanes_where((D2 > far * far) & (d2 < beyond2) & (body == of_body_[p]));
          for (; near != 0; near &= near - 1) {
            const int lane = std::countr_zero(near);
            if (d2[lane] < listed * listed)
              found(order_[p], order_[q + lane]);
            else
              beyond2 = std::min(beyond2, d2[lane]);
          }
        }
      });
    }
    return std::sqrt(beyond2);
  }

 private:
  /// The order of the grid's cells, and in it the columns that a search reads.
  void sort_columns(const std::vector<V>& x, double horizon) {
    order_ = grid_.sort(x, horizon);
    const std::size_t n = x.size();
    for (int k = 0; k < Dim; ++k) now_[k].resize(n + lanes), start_[k].resize(n + lanes);
    of_body_.resize(n + lanes);
    for (std::size_t p = 0; p < n; ++p) {
      const int a = order_[p];
      for (int k = 0; k < Dim; ++k) now_[k][p] = x[a][k], start_[k][p] = X_[a][k];
      of_body_[p] = body_[a];
    }
  }

  std::vector<V> X_;       // m
  std::vector<int> body_;  // in rising order
  // of a search
  CellGrid<Dim> grid_;
  std::vector<int> order_;
  std::array<std::vector<double>, Dim> now_, start_;  // m
  std::vector<double> of_body_;
};

}  // namespace taut::inline TAUT_ISA
