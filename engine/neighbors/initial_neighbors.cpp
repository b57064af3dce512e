#include "engine/neighbors/initial_neighbors.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "engine/core/parallel.hpp"
#include "engine/core/point.hpp"
#include "engine/neighbors/linked.hpp"
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
  std::vector<int> body(n);
  for (int i = 0; i < n; ++i) body[i] = initial.body[order[i]];
  NeighborSearch<Dim>()(grid, sorted, reach, threads, found, body.data());
  const auto list = [&](int place) {  // padded with the particle itself
    return std::span(found.j.data() + static_cast<std::size_t>(lanes) * found.begin[place],
                     static_cast<std::size_t>(lanes) * (found.begin[place + 1] - found.begin[place]));
  };
  NeighborLists near;
  near.begin.assign(n + 1, 0);
  parallel_for(n, threads, [&](int place) {
    near.begin[order[place] + 1] = list(place).size() - std::ranges::count(list(place), place);
  });
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

NeighborLists linked_neighbors(const InitialParticles& initial, double reach, double spacing, int threads) {
  NeighborLists all = initial_neighbors(initial, reach, threads), kept;
  const auto squared = [&](int i, int j) {
    const double r = distance_between(initial.x[i], initial.x[j], initial.dim) / spacing;
    return r * r;
  };
  const int n = initial.size();
  kept.begin.assign(n + 1, 0);
  parallel_for(n, threads, [&](int i) {
    const std::span<int> own(all.j.data() + all.begin[i], all.begin[i + 1] - all.begin[i]);
    kept.begin[i + 1] = bring_linked_to_front(
        own, [&](int j) { return squared(i, j); }, squared);
  });
  std::partial_sum(kept.begin.begin(), kept.begin.end(), kept.begin.begin());
  if (kept.begin[n] == all.begin[n]) return all;
  kept.j.resize(kept.begin[n]);
  parallel_for(n, threads, [&](int i) {
    std::copy_n(all[i].begin(), kept.begin[i + 1] - kept.begin[i], kept.j.begin() + kept.begin[i]);
  });
  return kept;
}

}  // namespace taut
