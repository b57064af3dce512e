#pragma once

#include <vector>

#include "engine/neighbors/neighbors.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Calls visit(i, j), i < j, for every two particles of one body at most `reach` apart as they were laid.
template <int Dim, class Visit>
void for_each_close_pair_in(const Snapshot& start, double reach, const Visit& visit) {
  std::vector<Vec<double, Dim>> X(start.size());
  for (std::size_t i = 0; i < X.size(); ++i)
    for (std::size_t k = 0; k < Dim; ++k) X[i][static_cast<int>(k)] = start.x0[Dim * i + k];
  CellGrid<Dim> grid;
  const std::vector<int> order = grid.sort(X, reach);
  for (const int i : order) {
    grid.for_each_row(X[i], [&](int first, int last) {
      for (int place = first; place < last; ++place) {
        const int j = order[place];
        if (i >= j || start.body[i] != start.body[j]) continue;
        const Vec<double, Dim> d = X[i] - X[j];
        if (dot(d, d) <= reach * reach) visit(i, j);
      }
    });
  }
}
template <class Visit>
void for_each_close_pair(const Snapshot& start, double reach, const Visit& visit) {
  start.dim == 3 ? for_each_close_pair_in<3>(start, reach, visit)
                 : for_each_close_pair_in<2>(start, reach, visit);
}

}  // namespace taut
