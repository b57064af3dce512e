#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/neighbors/neighbors.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// `x`: n × Dim, m.
template <int Dim>
class PlacesInCells {
 public:
  PlacesInCells(const std::vector<double>& x, double reach) : reach_(reach), x_(x.size() / Dim) {
    for (std::size_t i = 0; i < x_.size(); ++i)
      for (std::size_t k = 0; k < Dim; ++k) x_[i][static_cast<int>(k)] = x[Dim * i + k];
    order_ = grid_.sort(x_, reach);
  }

  const std::vector<int>& order() const { return order_; }
  /// Also visits i.
  template <class Visit>
  void for_each_around(int i, const Visit& visit) const {
    grid_.for_each_row(x_[i], [&](int first, int last) {
      for (int place = first; place < last; ++place) {
        const Vec<double, Dim> d = x_[order_[place]] - x_[i];
        if (dot(d, d) <= reach_ * reach_) visit(order_[place]);
      }
    });
  }

 private:
  double reach_;
  std::vector<Vec<double, Dim>> x_;
  CellGrid<Dim> grid_;
  std::vector<int> order_;
};

/// Calls visit(i, j) on one thread for all `wanted` pairs i < j at most `reach` (in m) apart, in a fixed order.
template <int Dim, class Wanted, class Visit>
void for_each_pair_within(const std::vector<double>& x, double reach, const Wanted& wanted,
                          const Visit& visit, int threads = 1) {
  constexpr int block = 64;  // particles
  const PlacesInCells<Dim> places(x, reach);
  const std::vector<int>& order = places.order();
  const int n = static_cast<int>(order.size());
  using Pairs = std::vector<std::pair<int, int>>;
  const auto pairs_of = [&](int b) {
    Pairs pairs;
    for (int k = block * b; k < std::min(block * (b + 1), n); ++k)
      places.for_each_around(order[k], [&](int j) {
        if (order[k] < j && wanted(order[k], j)) pairs.emplace_back(order[k], j);
      });
    return pairs;
  };
  make_in_order((n + block - 1) / block, threads, pairs_of, [&](int, const Pairs& pairs) {
    for (const auto& [i, j] : pairs) visit(i, j);
  });
}

/// Visits pairs within a body, by initial positions.
template <class Visit>
void for_each_close_pair(const Snapshot& start, double reach, const Visit& visit, int threads = 1) {
  const auto of_one = [&](int i, int j) { return start.body[i] == start.body[j]; };
  start.dim == 3 ? for_each_pair_within<3>(start.x0, reach, of_one, visit, threads)
                 : for_each_pair_within<2>(start.x0, reach, of_one, visit, threads);
}

/// Visits pairs of two bodies, by current positions.
template <class Visit>
void for_each_meeting_pair(const Snapshot& now, double reach, const Visit& visit) {
  const auto of_two = [&](int i, int j) { return now.body[i] != now.body[j]; };
  now.dim == 3 ? for_each_pair_within<3>(now.x, reach, of_two, visit)
               : for_each_pair_within<2>(now.x, reach, of_two, visit);
}

}  // namespace taut
