#include "engine/neighbors/initial_neighbors.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "engine/neighbors/neighbors.hpp"

namespace taut {

namespace {

template <int Dim>
NeighborLists neighbors_of(const InitialParticles& initial, double reach, int threads) {
  const int n = initial.size();
  std::vector<Vec<double, Dim>> x(n), sorted(n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < Dim; ++k) x[i][k] = initial.x[i][k];
  CellGrid<Dim> grid;
  const std::vector<int> order = grid.sort(x, reach);
  for (int i = 0; i < n; ++i) sorted[i] = x[order[i]];
  Neighbors found;
  NeighborSearch<Dim>()(grid, sorted, reach, threads, found,
                        [&](int i, int j) { return initial.body[order[i]] == initial.body[order[j]]; });
  const auto list = [&](int place) {  // of the search, which fills it up with the particle itself
    return std::span(found.j.data() + static_cast<std::size_t>(lanes) * found.begin[place],
                     static_cast<std::size_t>(lanes) * (found.begin[place + 1] - found.begin[place]));
  };
  NeighborLists near;
  near.begin.assign(n + 1, 0);
  for (int place = 0; place < n; ++place)
    near.begin[order[place] + 1] = list(place).size() - std::ranges::count(list(place), place);
  std::partial_sum(near.begin.begin(), near.begin.end(), near.begin.begin());
  near.j.resize(near.begin[n]);
  parallel_for(n, threads, [&](int place) {
    int* const first = near.j.data() + near.begin[order[place]];
    int* last = first;
    for (const int other : list(place))
      if (other != place) *last++ = order[other];
    std::sort(first, last);
  });
  return near;
}

}  // namespace

std::size_t NeighborLists::find(int i, int other) const {
  return std::lower_bound(j.begin() + static_cast<std::ptrdiff_t>(begin[i]),
                          j.begin() + static_cast<std::ptrdiff_t>(begin[i + 1]), other) -
         j.begin();
}

NeighborLists initial_neighbors(const InitialParticles& initial, double reach, int threads) {
  return initial.dim == 3 ? neighbors_of<3>(initial, reach, threads)
                          : neighbors_of<2>(initial, reach, threads);
}

}  // namespace taut
