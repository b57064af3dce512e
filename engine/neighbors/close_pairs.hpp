#pragma once

#include <vector>

#include "engine/neighbors/neighbors.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Calls visit(i, j), i < j, for every two particles at places `x`, n × Dim, that are at most `reach` apart, m, and that
/// are `wanted`(i, j).
template <int Dim, class Wanted, class Visit>
void for_each_pair_within(const std::vector<double>& x, double reach, const Wanted& wanted,
                          const Visit& visit) {
  std::vector<Vec<double, Dim>> X(x.size() / Dim);
  for (std::size_t i = 0; i < X.size(); ++i)
    for (std::size_t k = 0; k < Dim; ++k) X[i][static_cast<int>(k)] = x[Dim * i + k];
  CellGrid<Dim> grid;
  const std::vector<int> order = grid.sort(X, reach);
  for (const int i : order) {
    grid.for_each_row(X[i], [&](int first, int last) {
      for (int place = first; place < last; ++place) {
        const int j = order[place];
        if (i >= j || !wanted(i, j)) continue;
        const Vec<double, Dim> d = X[i] - X[j];
        if (dot(d, d) <= reach * reach) visit(i, j);
      }
    });
  }
}

/// Every two particles of one body, as they were laid.
template <class Visit>
void for_each_close_pair(const Snapshot& start, double reach, const Visit& visit) {
  const auto of_one = [&](int i, int j) { return start.body[i] == start.body[j]; };
  start.dim == 3 ? for_each_pair_within<3>(start.x0, reach, of_one, visit)
                 : for_each_pair_within<2>(start.x0, reach, of_one, visit);
}

/// Every two particles of two bodies, where they are.
template <class Visit>
void for_each_meeting_pair(const Snapshot& now, double reach, const Visit& visit) {
  const auto of_two = [&](int i, int j) { return now.body[i] != now.body[j]; };
  now.dim == 3 ? for_each_pair_within<3>(now.x, reach, of_two, visit)
               : for_each_pair_within<2>(now.x, reach, of_two, visit);
}

}  // namespace taut
