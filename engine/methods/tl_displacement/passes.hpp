#pragma once

#include "engine/core/parallel.hpp"
#include "engine/methods/tl_displacement/fields.hpp"
#include "engine/solver/kick.hpp"
#include "engine/terms/hourglass/hourglass_force.hpp"
#include "engine/terms/hourglass/pair_shear.hpp"

namespace taut {

template <const TlDisplacementFormulation& M, int Dim>
void drift(const TlDisplacementFields<Dim>& f, double dt, const Threads& threads) {
  parallel_for(f.groups(), threads, [&](int group) {
    const int first = lanes * group, count = f.size - first;
    const Vec<Pack, Dim> v = load_four(f.v + first, count);
    const Vec<Pack, Dim> x = load_four(f.x + first, count) + filled<Pack>(dt) * v;
    store_four(x, f.x + first, count);
    if constexpr (M.pair_force == PairForce::shear) put(v, f.velocity, first);
    put(x - load_four(f.X + first, count), f.displacement, first);
  });
}

template <int Dim>
Mat<Pack, Dim> deformation(const TlDisplacementFields<Dim>& f, int group) {
  Mat<Pack, Dim> F = product(f.pairs.difference_sum(f.displacement, group), f.sites[group].B);
  for (int k = 0; k < Dim; ++k) F(k, k) += 1;
  return F;
}

/// Computes V P(F) B; with pair shear, the isotropic P and the pair shear modulus g.
template <const TlDisplacementFormulation& M, int Dim>
void stress_pass(const TlDisplacementFields<Dim>& f, const Threads& threads) {
  f.laws.template visit<M>([&]<class L>(const L* of_materials) {
    const LawsOfFour<L, M.several_materials> laws{of_materials, f.material};
    parallel_pass(f.groups(), threads, [&](int group) {
      const int first = lanes * group;
      const Mat<Pack, Dim> F = deformation(f, group);
      const Sites<Dim>& site = f.sites[group];
      if constexpr (M.pair_force == PairForce::shear) {
        const Mat<Pack, Dim> rate = product(f.pairs.difference_sum(f.velocity, group), site.B);
        const Pack chi = load(f.viscosity[0] + first), J = determinant(F);
        const Pack g = laws(group, [&](const auto& law) {
          return pair_shear_modulus(filled<Pack>(f.shear_factor * law.G), J);
        });
        const Mat<Pack, Dim> P = laws(
            group, [&](const auto& law) { return isotropic_piola(F, rate, filled<Pack>(law.K), g, chi); });
        store(g, f.shear[0] + first);
        put(P, f.stress, first);
        return;
      }
      const Mat<Pack, Dim> P = laws(group, [&](const auto& law) { return law.piola(F, determinant(F)); });
      put(product(P, site.V0 * site.B), f.stress, first);
      if constexpr (M.pair_force == PairForce::hourglass) put(F, f.F, first);
    });
  });
}

template <int Dim>
Mat<Pack, Dim> tensor_at(const ColumnsView<Dim * Dim>& columns, int first) {
  Mat<Pack, Dim> A;
  for (int k = 0; k < Dim * Dim; ++k) A(k / Dim, k % Dim) = load(columns[k] + first);
  return A;
}

/// In N.
template <const TlDisplacementFormulation& M, int Dim>
Vec<Pack, Dim> pair_force(const TlDisplacementFields<Dim>& f, int group) {
  constexpr bool shear = M.pair_force == PairForce::shear;
  const int first = lanes * group;
  const ColumnsView<Dim* Dim>& tensors = shear ? f.stress : f.F;
  const Vec<Pack, Dim> u_i = vector_at<Dim>(f.displacement, first);
  const Mat<Pack, Dim> A_i = tensor_at<Dim>(tensors, first);
  [[maybe_unused]] Pack g_i{};
  if constexpr (shear) g_i = load(f.shear[0] + first);
  Vec<Pack, Dim> sum{};
  f.bonds.for_each(group, [&](const LaneSlot& slot, const auto& bond) {
    Vec<Pack, Dim> X, u_j;
    Pack of_j[Dim * Dim];
    Mat<Pack, Dim> A_j;
    for (int k = 0; k < Dim; ++k) X[k] = bond.c[k];
    gather(f.displacement, first, slot, u_j.c);
    gather(tensors, first, slot, of_j);
    for (int k = 0; k < Dim * Dim; ++k) A_j(k / Dim, k % Dim) = of_j[k];
    const Vec<Pack, Dim> x = X + (u_i - u_j);
    if constexpr (shear) {
      Pack g_j[1];
      gather(f.shear, first, slot, g_j);
      sum += pair_shear_force(A_i, A_j, g_i, g_j[0], X, x, bond.c[Dim]);
    } else {
      sum += hourglass_force(A_i, A_j, X, x, bond.c[Dim], bond.c[Dim + 1]);
    }
  });
  return sum;
}

/// In N.
template <const TlDisplacementFormulation& M, int Dim>
Vec<Pack, Dim> internal_force(const TlDisplacementFields<Dim>& f, int group) {
  if constexpr (M.pair_force == PairForce::none) return f.pairs.pair_sum(f.stress, group);
  if constexpr (M.pair_force == PairForce::shear) return pair_force<M>(f, group);
  return f.pairs.pair_sum(f.stress, group) + pair_force<M>(f, group);
}

/// Advances v, then x by half a step. Returns the maximum v², m²/s².
template <const TlDisplacementFormulation& M, int Dim>
double force_pass(const TlDisplacementFields<Dim>& f, const Kick<Dim>& kick, const Threads& threads) {
  if (kick.impulse)
    parallel_for(f.groups(), threads,
                 [&](int group) { kick.record(lanes * group, internal_force<M>(f, group)); });
  return parallel_max(f.groups(), threads, [&](int group) {
    const int first = lanes * group, count = f.size - first;
    const Sites<Dim>& site = f.sites[group];
    const Vec<Pack, Dim> v = kick.by_forces(first, site.mobile * site.per_m, internal_force<M>(f, group));
    store_four(load_four(f.x + first, count) + filled<Pack>(0.5 * kick.dt) * v, f.x + first, count);
    return greatest(dot(v, v));
  });
}

template <const TlDisplacementFormulation&, int Dim>
void deform(const TlDisplacementFields<Dim>& f, const int* groups, int count, Mat<Pack, Dim>* out,
            const Threads& threads) {
  parallel_pass(count, threads, [&](int k) { out[k] = deformation(f, groups[k]); });
}

}  // namespace taut
