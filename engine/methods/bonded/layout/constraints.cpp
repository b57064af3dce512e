#include "engine/methods/bonded/layout/constraints.hpp"

#include <algorithm>

#include "engine/layout/material_point.hpp"
#include "engine/neighbors/neighbors_of_one.hpp"

namespace taut {
namespace {

template <int Dim>
bool is_single_row(const std::vector<Vec<double, Dim>>& beside) {
  if constexpr (Dim == 2) return beside.empty();
  constexpr double sine = 0.3;  // rows at round edges are bent
  return std::ranges::all_of(beside, [&](const Vec<double, Dim>& d) {
    const double along = dot(d, beside[0]), both = dot(d, d) * dot(beside[0], beside[0]);
    return both - along * along <= sine * sine * both;
  });
}

template <int Dim>
Constraints with_pins(const Constraints& constraints, const InitialParticles& initial, double spacing) {
  Constraints out = constraints;
  if (std::ranges::none_of(constraints, is_rigid)) return out;
  const NeighborsOfOne<Dim> neighbors(initial, link_of_neighbors * spacing);
  for (int i = 0; i < initial.size(); ++i) {
    if (!is_rigid(constraints[i])) continue;
    std::vector<Vec<double, Dim>> beside;
    for (const int j : neighbors(i)) {
      if (!is_rigid(constraints[j])) continue;
      Vec<double, Dim>& d = beside.emplace_back();
      for (int k = 0; k < Dim; ++k) d[k] = initial.x[j][k] - initial.x[i][k];
    }
    if (is_single_row(beside)) out[i] = Constraint::pinned;
  }
  return out;
}

}  // namespace

Constraints make_constraints(const Scene& scene, const InitialParticles& initial) {
  Constraints constraints(initial.size());
  for (int i = 0; i < initial.size(); ++i) {
    const Body& body = scene.bodies[initial.body[i]];
    const int drive = initial.drive[i];
    // with on_boundary, the half cells at a driven face deform
    if (drive >= 0 && !body.on_boundary && !ends_before_run(body.drives[drive], scene))
      constraints[i] = Constraint::driven;
    else if (initial.clamped[i])
      constraints[i] = Constraint::clamped;
  }
  return scene.dim == 3 ? with_pins<3>(constraints, initial, scene.spacing)
                        : with_pins<2>(constraints, initial, scene.spacing);
}

}  // namespace taut
