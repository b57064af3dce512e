#pragma once

#include <vector>

#include "engine/neighbors/neighbors.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// |x_i − x_j|², m².
inline double squared_distance(const Snapshot& now, int i, int j) {
  const double* a = now.x.data() + static_cast<std::ptrdiff_t>(i) * now.dim;
  const double* b = now.x.data() + static_cast<std::ptrdiff_t>(j) * now.dim;
  double squared = 0;
  for (int k = 0; k < now.dim; ++k) squared += (a[k] - b[k]) * (a[k] - b[k]);
  return squared;
}

/// Calls visit(i, j), i < j, for every two particles of one body at most `reach` apart.
template <int Dim, class Visit>
void for_each_close_pair_in(const Snapshot& now, double reach, const Visit& visit) {
  std::vector<Vec<double, Dim>> x(now.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < Dim; ++k) x[i][static_cast<int>(k)] = now.x[Dim * i + k];
  CellGrid<Dim> grid;
  const std::vector<int> order = grid.sort(x, reach);
  for (const int i : order) {
    grid.for_each_row(x[i], [&](int first, int last) {
      for (int place = first; place < last; ++place) {
        const int j = order[place];
        if (i < j && now.body[i] == now.body[j] && squared_distance(now, i, j) <= reach * reach) visit(i, j);
      }
    });
  }
}
template <class Visit>
void for_each_close_pair(const Snapshot& now, double reach, const Visit& visit) {
  now.dim == 3 ? for_each_close_pair_in<3>(now, reach, visit) : for_each_close_pair_in<2>(now, reach, visit);
}

}  // namespace taut
