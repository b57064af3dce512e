#include "engine/families/bonded/pins.hpp"

#include <algorithm>

#include "engine/neighbors/neighbors_of_one.hpp"
#include "engine/scene/material_point.hpp"

namespace taut {
namespace {

template <int Dim>
bool in_one_row(const std::vector<Vec<double, Dim>>& beside) {
  if constexpr (Dim == 2) return beside.empty();
  constexpr double sine = 0.3;  // the row of a round edge is bent
  return std::ranges::all_of(beside, [&](const Vec<double, Dim>& d) {
    const double along = dot(d, beside[0]), both = dot(d, d) * dot(beside[0], beside[0]);
    return both - along * along <= sine * sine * both;
  });
}

template <int Dim>
std::vector<int> pins_of(const InitialParticles& initial, double spacing) {
  std::vector<int> found;
  if (std::ranges::count(initial.held, 1) == 0) return found;
  const NeighborsOfOne<Dim> neighbors(initial, link_of_neighbors * spacing);
  for (int i = 0; i < initial.size(); ++i) {
    if (!initial.held[i]) continue;
    std::vector<Vec<double, Dim>> beside;
    for (const int j : neighbors(i)) {
      if (!initial.held[j]) continue;
      Vec<double, Dim>& d = beside.emplace_back();
      for (int k = 0; k < Dim; ++k) d[k] = initial.x[j][k] - initial.x[i][k];
    }
    if (in_one_row(beside)) found.push_back(i);
  }
  return found;
}

}  // namespace

std::vector<int> pins(const InitialParticles& initial, double spacing) {
  return initial.dim == 3 ? pins_of<3>(initial, spacing) : pins_of<2>(initial, spacing);
}

}  // namespace taut
