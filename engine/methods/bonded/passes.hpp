#pragma once

#include <algorithm>

#include "engine/core/parallel.hpp"
#include "engine/methods/bonded/bond_sums.hpp"
#include "engine/methods/bonded/closed_law.hpp"
#include "engine/methods/bonded/fields.hpp"
#include "engine/solver/kick.hpp"

namespace taut {

/// One loop computes the cube roots of a block, so that their dependency chains overlap.
inline constexpr int groups_of_block = 8;
template <int Dim>
int block_count(const BondedFields<Dim>& f) {
  return (f.group_count() + groups_of_block - 1) / groups_of_block;
}

template <int Dim>
struct StrainOfFour {
  Mat<Pack, Dim> F;      // 0 where V is 0
  Vec<Pack, Dim> force;  // of the bonds, N
  Pack energy;           // of the bonds, J, if requested
  Pack stiffest;         // maximum stiffness, relative to rest
  Pack root;             // c^(−1/3) of the default law (THEORY.md)
};

/// `dt`: half a step. Sets the particles' `places`.
template <const BondedFormulation&, int Dim>
void half_drift(const BondedFields<Dim>& f, double dt, const Threads& threads) {
  parallel_for(f.group_count(), threads, [&](int group) {
    const int first = lanes * group;
    if (first + lanes > f.size) {
      for (int i = first; i < f.size; ++i) f.x[i] += dt * f.v[i], f.set_place(i);
      return;
    }
    Pack x_rows[Dim], v_rows[Dim], x[Dim], v[Dim];
    double* const x_at = reinterpret_cast<double*>(&f.x[first]);
    const double* const v_at = reinterpret_cast<const double*>(&f.v[first]);
#pragma GCC unroll 3
    for (int k = 0; k < Dim; ++k) {
      v_rows[k] = load(v_at + lanes * k);
      x_rows[k] = load(x_at + lanes * k) + dt * v_rows[k];
      store(x_rows[k], x_at + lanes * k);
    }
    separate(x_rows, x), separate(v_rows, v);
#pragma GCC unroll 3
    for (int k = 0; k < Dim; ++k) {
      store(x[k], f.places[k] + first);
      store(x[k] + f.lead * v[k], f.places[Dim + k] + first);
    }
  });
}

template <bool WithEnergy, int Dim, class Storage>
void strain(const BondedFields<Dim>& f, const BondsView<Dim, Storage>& bonds, int group,
            StrainOfFour<Dim>& out) {
  const BondSums<Dim> sums = bond_sums<WithEnergy>(bonds.packed, f.places, group, filled<Pack>(f.least_r2));
  const Mat<Pack, Dim> F = product_transposed(sums.A, f.B_of(group));
  for (int a = 0; a < Dim; ++a) {
    out.force[a] = sums.force[a];
    for (int k = 0; k < Dim; ++k) out.F(a, k) = F(a, k);
  }
  if constexpr (WithEnergy) out.energy = sums.energy;
  const Pack closing = f.law(group).V > 0 ? closing_stiffness(determinant(F)) : Pack{};
  out.stiffest = max(Pack(sums.stiffest + bond_stiffness_offset), closing);
}

/// V_i W(F_i) minus the cancelled energy, J.
template <const BondedFormulation& M, int Dim, class Storage>
Pack energy_of_four(const BondedFields<Dim>& f, const BondsView<Dim, Storage>& bonds, int group,
                    const Mat<Pack, Dim>& F) {
  const GroupLaw& own = f.law(group);
  Sym<Pack, Dim> C = right_cauchy_green(F);
  for (int k = 0; k < Dim; ++k) C(k, k) = own.V > 0 ? C(k, k) : filled<Pack>(1);
  const Pack W = f.uses_group_law ? own.law.energy(F) : f.laws.template visit<M>([&](const auto* laws) {
    return closed_energy(laws, f.material + lanes * group, F);
  });
  return own.V * W - bonds.cancelled.energy(group, C);
}

template <const BondedFormulation& M, int Dim>
[[gnu::noinline]] Mat<Pack, Dim> piola_of_chosen_law(const BondedFields<Dim>& f, int group,
                                                     const Mat<Pack, Dim>& F) {
  return f.laws.template visit<M>(
      [&](const auto* laws) { return closed_piola(laws, f.material + lanes * group, F); });
}

/// Stores Q = T B.
template <const BondedFormulation& M, int Dim, class Storage>
void set_stress(const BondedFields<Dim>& f, const BondsView<Dim, Storage>& bonds, int group,
                const StrainOfFour<Dim>& now) {
  const GroupLaw& own = f.law(group);
  const Mat<Pack, Dim>& F = now.F;
  const Mat<Pack, Dim> P =
      f.uses_group_law ? own.law.piola(F, now.root) : piola_of_chosen_law<M>(f, group, F);
  const Mat<Pack, Dim> FS = product(F, bonds.cancelled.slopes(group, right_cauchy_green(F)));
  Mat<Pack, Dim> T;
  for (int a = 0; a < Dim; ++a)
    for (int k = 0; k < Dim; ++k) T(a, k) = own.V * P(a, k) - FS(a, k);
  const Mat<Pack, Dim> Q = product(T, f.B_of(group));
  for (int a = 0; a < Dim; ++a)
    for (int k = 0; k < Dim; ++k) store(Q(a, k), f.Q[a * Dim + k] + lanes * group);
}

/// Returns the maximum stiffness relative to rest.
template <const BondedFormulation& M, int Dim>
double stress_pass(const BondedFields<Dim>& f, const Threads& threads) {
  return f.with_bonds([&](const auto& bonds) {
    return parallel_max(block_count(f), threads, [&](int n) {
      const int first = groups_of_block * n, count = std::min(groups_of_block, f.group_count() - first);
      StrainOfFour<Dim> of[groups_of_block];
      Pack stiffest{};
      for (int k = 0; k < count; ++k) {
        strain<false>(f, bonds, first + k, of[k]);
        for (int a = 0; a < Dim; ++a) f.bond_force[first + k][a] = of[k].force[a];
        stiffest = max(stiffest, of[k].stiffest);
      }
      for (int k = 0; f.uses_group_law && k < count; ++k)
        of[k].root = ClosedNeoHookean<Pack>::root(determinant(of[k].F));
      for (int k = 0; k < count; ++k) set_stress<M>(f, bonds, first + k, of[k]);
      return greatest(stiffest);
    });
  });
}

/// Bond and stress forces, N.
template <int Dim, class Storage>
[[gnu::always_inline]] inline Vec<Pack, Dim> inner_force(const BondedFields<Dim>& f,
                                                         const BondsView<Dim, Storage>& bonds, int group) {
  Vec<Pack, Dim> force = f.bond_force[group];
  add_stress_force(bonds.packed, f.Q, group, force);
  return force;
}

/// Advances v, then x by half a step. Returns the maximum v², m²/s².
template <const BondedFormulation&, int Dim>
double force_pass(const BondedFields<Dim>& f, const Kick<Dim>& kick, const Threads& threads) {
  return f.with_bonds([&](const auto& bonds) {
    if (kick.impulse)
      parallel_for(f.group_count(), threads,
                   [&](int group) { kick.record(lanes * group, inner_force(f, bonds, group)); });
    return parallel_max(block_count(f), threads, [&](int n) {
      Pack fastest{};
      for (int group = groups_of_block * n; group < std::min(groups_of_block * (n + 1), f.group_count());
           ++group) {
        const int first = lanes * group;
        Vec<Pack, Dim> force = inner_force(f, bonds, group);
        kick.add_contact(first, force);
        const Pack mobility = kick.dt * load(f.mobility + first);
        Pack change[Dim];
        for (int k = 0; k < Dim; ++k) change[k] = mobility * force[k];
        fastest = max_or_nan(fastest, kick.by_changes(first, change, 0.5 * kick.dt));
      }
      return greatest(fastest);
    });
  });
}

template <const BondedFormulation&, int Dim>
void inner_forces(const BondedFields<Dim>& f, Vec<double, Dim>* out, const Threads& threads) {
  f.with_bonds([&](const auto& bonds) {
    parallel_for(f.group_count(), threads, [&](int group) {
      const Vec<Pack, Dim> force = inner_force(f, bonds, group);
      for (int i = lanes * group, lane = 0; lane < lanes && i < f.size; ++i, ++lane)
        out[i] = lane_of(force, lane);
    });
  });
}

/// Returns energies in J.
template <const BondedFormulation& M, int Dim>
Pack strain_and_energy(const BondedFields<Dim>& f, int group, StrainOfFour<Dim>& now) {
  return f.with_bonds([&](const auto& bonds) {
    strain<true>(f, bonds, group, now);
    return Pack(now.energy + energy_of_four<M>(f, bonds, group, now.F));
  });
}

/// In J, one pack per group.
template <const BondedFormulation& M, int Dim>
void energy_pass(const BondedFields<Dim>& f, AlignedPack* out, const Threads& threads) {
  parallel_pass(f.group_count(), threads, [&](int group) {
    StrainOfFour<Dim> now;
    out[group].value = strain_and_energy<M>(f, group, now);
  });
}

template <const BondedFormulation& M, int Dim>
ShownStress<Pack, Dim> stress_of_four(const BondedFields<Dim>& f, int group, const Mat<Pack, Dim>& F) {
  if (f.uses_group_law) return shown_neo_hookean(f.law(group).law.K, f.law(group).law.G, F);
  ShownStress<Pack, Dim> all{};
  f.laws.template visit<M>([&](const auto* laws) {
    for (int lane = 0; lane < std::min(lanes, f.size - lanes * group); ++lane) {
      const ShownStress<double, Dim> one =
          shown_stress(laws[f.material[lanes * group + lane]], lane_of(F, lane));
      all.J[lane] = one.J, all.p[lane] = one.p, all.s_zz[lane] = one.s_zz;
      for (int k = 0; k < Sym<double, Dim>::size; ++k) all.s.c[k][lane] = one.s.c[k];
    }
    return 0;
  });
  return all;
}

/// Fills out[k] for groups[k]. `u`: displacements, m.
template <const BondedFormulation& M, int Dim>
void show_pass(const BondedFields<Dim>& f, const RecoveredView& recovered, const AlignedPack* u,
               const int* groups, int count, ShownGroup<Dim>* out, const Threads& threads) {
  parallel_pass(count, threads, [&](int k) {
    const int group = groups[k];
    StrainOfFour<Dim> now;
    out[k].energy = strain_and_energy<M>(f, group, now);
    // the identity replaces F where the bonds determine none
    const PackIndex has_own = f.law(group).V > 0;
    for (int a = 0; a < Dim; ++a) now.F(a, a) = has_own ? now.F(a, a) : filled<Pack>(1);
    Mat<Pack, Dim> F = recovered_deformations<Dim>(recovered, u, f.size, lanes * group, now.F);
    // no force controls the volume ratio of the recovered F
    if constexpr (Dim == 3)
      keep_volume(recovered, f.size, lanes * group, F, has_own ? determinant(now.F) : determinant(F));
    out[k].stress = stress_of_four<M>(f, group, F);
  });
}

}  // namespace taut
