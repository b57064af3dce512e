#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/core/pack.hpp"
#include "engine/neighbors/neighbors.hpp"

namespace taut {

/// Columns with `lanes` readable entries after the last one.
template <int Dim>
struct PointColumns {
  const double* now[Dim];    // m
  const double* start[Dim];  // m
  const double* body;
};

/// Finds the points q among first … last − 1 in the body of point p with |x_q − x_p|² < near2 and |X_q − X_p|² > far2.
/// Stores indices and squared distances [m²].
template <int Dim>
int find_near_points(const PointColumns<Dim>& points, int p, int first, int last, double near2, double far2,
                     int* found, double* distance2) {
  int count = 0;
  for (int q = first; q < last; q += lanes) {
    Pack d2{}, D2{};
    for (int k = 0; k < Dim; ++k) {
      const Pack d = load(points.now[k] + q) - points.now[k][p],
                 D = load(points.start[k] + q) - points.start[k][p];
      d2 += d * d, D2 += D * D;
    }
    const Pack body = load(points.body + q);
    const unsigned in_row = last - q < lanes ? (1u << (last - q)) - 1 : (1u << lanes) - 1;
    unsigned near = in_row & lanes_where((D2 > far2) & (d2 < near2) & (body == points.body[p]));
    for (; near != 0; near &= near - 1) {
      const int lane = __builtin_ctz(near);
      found[count] = q + lane, distance2[count++] = d2[lane];
    }
  }
  return count;
}

template <int Dim>
class PointSearch {
 public:
  using V = Vec<double, Dim>;

  /// `start`: initial position, m. `body` must not decrease from call to call.
  void add(const V& start, int body) {
    X_.push_back(start);
    body_.push_back(body);
  }
  int size() const { return static_cast<int>(X_.size()); }
  const std::vector<int>& bodies() const { return body_; }

  /// Considers pairs within a body that were initially farther apart than `far`. Calls found(a, b) once for each pair
  /// nearer than `listed`. Returns the least distance of the other pairs, at most `horizon`. `x`: current positions, in
  /// the order of `add`. Lengths in m.
  template <class Found>
  double find(const std::vector<V>& x, double listed, double horizon, double far, const Found& found) {
    if (x.empty()) return horizon;
    sort_columns(x, horizon);
    const int n = size();
    PointColumns<Dim> points;
    for (int k = 0; k < Dim; ++k) points.now[k] = now_[k].data(), points.start[k] = start_[k].data();
    points.body = of_body_.data();
    near_.resize(n), distance2_.resize(n);
    double beyond2 = horizon * horizon;
    for (int p = 0; p < n; ++p) {
      grid_.for_each_row(x[order_[p]], [&](int first, int last) {
        const int count = find_near_points(points, p, std::max(first, p + 1), last, beyond2, far * far,
                                           near_.data(), distance2_.data());
        for (int k = 0; k < count; ++k) {
          if (distance2_[k] < listed * listed)
            found(order_[p], order_[near_[k]]);
          else
            beyond2 = std::min(beyond2, distance2_[k]);
        }
      });
    }
    return std::sqrt(beyond2);
  }

 private:
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

  std::vector<V> X_;       // initial, m
  std::vector<int> body_;  // ascending
  CellGrid<Dim> grid_;
  std::vector<int> order_;
  std::array<std::vector<double>, Dim> now_, start_;  // m
  std::vector<double> of_body_;
  std::vector<int> near_;
  std::vector<double> distance2_;  // m²
};

}  // namespace taut
