#pragma once

#include "engine/core/columns.hpp"
#include "engine/core/parallel.hpp"
#include "engine/methods/finite_elements/element.hpp"
#include "engine/methods/finite_elements/formulation.hpp"
#include "engine/solver/kick.hpp"

namespace taut {

template <const FiniteElementFormulation& M, int Dim>
inline constexpr int nodes_of_element = power_of(M.element_order + 1, Dim);

template <const FiniteElementFormulation& M, int Dim>
using StrainOf = ElementStrain<M.element_order + 1, Dim>;

template <const FiniteElementFormulation& M, int Dim>
void drift(const FiniteElementFields<Dim>& f, double dt, const Threads& threads) {
  parallel_for(f.size, threads, [&](int i) {
    f.x[i] += dt * f.v[i];
    f.u[i] = f.x[i] - f.X[i];
  });
}

template <const FiniteElementFormulation& M, int Dim>
[[gnu::always_inline]] inline void gather_nodes(const FiniteElementFields<Dim>& f, int group,
                                                Pack (&u)[Dim][nodes_of_element<M, Dim>]) {
  constexpr int N = nodes_of_element<M, Dim>;
  const int* const node = f.node + static_cast<std::ptrdiff_t>(group) * N * lanes;
  for (int a = 0; a < N; ++a) {
    const int* const of = node + a * lanes;
    for (int c = 0; c < Dim; ++c) u[c][a] = Pack{f.u[of[0]][c], f.u[of[1]][c], f.u[of[2]][c], f.u[of[3]][c]};
  }
}

template <const FiniteElementFormulation& M, int Dim>
const auto* points_of(const FiniteElementFields<Dim>& f, int group) {
  using Point = typename StrainOf<M, Dim>::Point;
  return static_cast<const Point*>(f.points) + static_cast<std::ptrdiff_t>(group) * nodes_of_element<M, Dim>;
}

template <const FiniteElementFormulation& M, int Dim>
void element_pass(const FiniteElementFields<Dim>& f, const Threads& threads) {
  constexpr int N = nodes_of_element<M, Dim>;
  f.laws.template visit<M>([&]<class L>(const L* of_materials) {
    const LawsOfFour<L, M.several_materials> laws{of_materials, f.material};
    parallel_pass(f.groups, threads, [&](int group) {
      Pack u[Dim][N], force[Dim][N];
      gather_nodes<M>(f, group, u);
      element_force<M.element_order + 1, Dim>(
          u, points_of<M>(f, group), [&](const auto& stress) { return laws(group, stress); }, force);
      double* const out = f.force + static_cast<std::ptrdiff_t>(group) * N * Dim * lanes;
      for (int a = 0; a < N; ++a)
        for (int c = 0; c < Dim; ++c) store(force[c][a], out + (a * Dim + c) * lanes);
    });
  });
}

/// Element forces on four nodes, N.
template <int Dim>
Vec<Pack, Dim> nodal_force(const FiniteElementFields<Dim>& f, int group) {
  Vec<Pack, Dim> force{};
  for (int lane = 0; lane < std::min(lanes, f.size - lanes * group); ++lane) {
    const int i = lanes * group + lane;
    Vec<double, Dim> sum{};
    for (int k = f.begin[i]; k < f.begin[i + 1]; ++k)
      for (int c = 0; c < Dim; ++c) sum[c] += f.force[f.slot[k] + c * lanes];
    set_lane(force, lane, sum);
  }
  return force;
}

/// Advances v, then x by half a step. Returns the maximum v², m²/s².
template <const FiniteElementFormulation& M, int Dim>
double node_pass(const FiniteElementFields<Dim>& f, const Kick<Dim>& kick, const Threads& threads) {
  const int groups = (f.size + lanes - 1) / lanes;
  if (kick.impulse)
    parallel_for(groups, threads, [&](int group) { kick.record(lanes * group, nodal_force(f, group)); });
  return parallel_max(groups, threads, [&](int group) {
    const int first = lanes * group, count = f.size - first;
    const Vec<Pack, Dim> v = kick.by_forces(first, f.mobility[group][0], nodal_force(f, group));
    store_four(load_four(f.x + first, count) + filled<Pack>(0.5 * kick.dt) * v, f.x + first, count);
    return greatest(dot(v, v));
  });
}

/// F̄ at the Gauss points: out[N k + q].
template <const FiniteElementFormulation& M, int Dim>
void strain_pass(const FiniteElementFields<Dim>& f, const int* groups, int count, Mat<Pack, Dim>* out,
                 const Threads& threads) {
  constexpr int N = nodes_of_element<M, Dim>;
  parallel_pass(count, threads, [&](int k) {
    Pack u[Dim][N];
    gather_nodes<M>(f, groups[k], u);
    const StrainOf<M, Dim> strain(u, points_of<M>(f, groups[k]));
    for (int q = 0; q < N; ++q) out[static_cast<std::ptrdiff_t>(k) * N + q] = strain.with_mean_volume(q);
  });
}

/// Bound of the elements' squared frequencies, 1/s², from mean deformation gradients.
template <const FiniteElementFormulation& M, int Dim>
double rate_pass(const FiniteElementFields<Dim>& f, const Threads& threads) {
  constexpr int N = nodes_of_element<M, Dim>;
  return f.laws.template visit<M>([&]<class L>(const L* of_materials) {
    const LawsOfFour<L, M.several_materials> laws{of_materials, f.material};
    return parallel_max(f.groups, threads, [&](int group) {
      Pack u[Dim][N];
      gather_nodes<M>(f, group, u);
      const auto* const points = points_of<M>(f, group);
      const StrainOf<M, Dim> strain(u, points);
      Mat<Pack, Dim> sum{};
      Pack volume{};
      for (int q = 0; q < N; ++q) sum += points[q].weight * strain.F[q], volume += points[q].weight;
      const Mat<Pack, Dim> F = (1 / volume) * sum;
      return greatest(f.rate[group][0] *
                      laws(group, [&](const auto& law) { return law.stiffness_bound(F, determinant(F)); }));
    });
  });
}

}  // namespace taut
