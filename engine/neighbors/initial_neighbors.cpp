#include "engine/neighbors/initial_neighbors.hpp"

#include <algorithm>

#include "engine/neighbors/neighbors.hpp"

namespace taut {

namespace {

template <int Dim>
std::vector<std::vector<int>> neighbors_of(const InitialParticles& initial, double reach) {
  const int n = initial.size();
  std::vector<Vec<double, Dim>> x(n), sorted(n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < Dim; ++k) x[i][k] = initial.x[i][k];
  CellGrid<Dim> grid;
  const std::vector<int> order = grid.sort(x, reach);
  for (int i = 0; i < n; ++i) sorted[i] = x[order[i]];
  Neighbors found;
  NeighborSearch<Dim>()(grid, sorted, reach, 1, found);
  std::vector<std::vector<int>> near(n);
  for (int i = 0; i < n; ++i) {
    const int id = order[i];
    for (int k = lanes * found.begin[i]; k < lanes * found.begin[i + 1]; ++k) {
      const int other = order[found.j[k]];
      if (other != id && initial.body[other] == initial.body[id]) near[id].push_back(other);
    }
    std::ranges::sort(near[id]);
  }
  return near;
}

}  // namespace

std::vector<std::vector<int>> initial_neighbors(const InitialParticles& initial, double reach) {
  return initial.dim == 3 ? neighbors_of<3>(initial, reach) : neighbors_of<2>(initial, reach);
}

}  // namespace taut
