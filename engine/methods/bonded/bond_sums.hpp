#pragma once

#include "engine/core/columns.hpp"
#include "engine/methods/bonded/cancelled.hpp"
#include "engine/methods/bonded/packed_bonds.hpp"
#include "engine/term_info.hpp"
#include "engine/terms/bond.hpp"

namespace taut {

template <int Dim>
struct BondSums {
  Mat<Pack, Dim> A{};      // Σ_j (x_j − x_i) ⊗ a_ij
  Vec<Pack, Dim> force{};  // N
  Pack energy{};           // J, if requested
  Pack stiffest{};         // maximum s + 1/(4s²)
};

/// With damping (THEORY.md). `places`: x, then x + 3 τ v.
template <bool WithEnergy, int Dim, class Storage>
[[gnu::always_inline]] inline BondSums<Dim> bond_sums(const PackedBondsView<Dim, Storage>& bonds,
                                                      const ColumnsView<2 * Dim>& places, int group,
                                                      const Pack& least_r2) {
  const int first = group * lanes;
  Vec<Pack, Dim> x_i, ahead_i;
  for (int k = 0; k < Dim; ++k) x_i[k] = load(places[k] + first), ahead_i[k] = load(places[Dim + k] + first);
  Mat<Pack, Dim> A{};
  Vec<Pack, Dim> force{};
  Pack energy{}, stiffest{};
  const auto& own = bonds.of(group);
  const auto* slots = bonds.slots(own);
  const auto* springs = bonds.springs(own);
  const auto* areas = bonds.a_ij(own);
  const auto add_bond = [&](int b) {  // returns x_j − x_i
    Pack place[2 * Dim];
    gather(places, first, slots[b], place);
    Vec<Pack, Dim> d, ahead;
    for (int k = 0; k < Dim; ++k) d[k] = place[k] - x_i[k], ahead[k] = place[Dim + k] - ahead_i[k];
    const auto& spring = springs[b];
    const Pack r2 = max(dot(d, d), least_r2), half_inverse = spring.half_inverse(r2);
    stiffest = max(stiffest, bond_stiffness(Pack(r2 * spring.per_r02()), half_inverse));
    const Pack s_ahead = dot(d, ahead) * spring.per_r02();  // s + 3 τ q̇
    const Pack pull = spring.third() * three_bond_slopes(s_ahead, half_inverse);
    for (int k = 0; k < Dim; ++k) force[k] += pull * d[k];
    if constexpr (WithEnergy) {
      const Pack s = r2 * spring.per_r02(), scale = unpacked(bonds.energy_scales(own)[b]);
      energy += scale * bond_energy(s > 0 ? s : filled<Pack>(1));
    }
    return d;
  };
  for (int b = 0; b < own.a_count; ++b) add_outer(A, filled<Pack>(1), add_bond(b), unpacked(areas[b]));
  for (int b = own.a_count; b < own.count; ++b) add_bond(b);
  return {A, force, energy, stiffest};
}
inline constexpr TermInfo bonded_damping_info{
    "damping", "f_i = Σ_j k_ij τ q̇_ij (x_j − x_i), q = ½ (λ² − 1), τ = damping dp √(ρ0/G)", "ours",
    "methods/bonded/bond_sums.hpp:bond_sums",
    "oenog: damping removes a zigzag and leaves the first mode nearly unchanged"};

/// Adds Σ_j (Q_i + Q_j) a_ij, N.
template <int Dim, class Storage>
[[gnu::always_inline]] inline void add_stress_force(const PackedBondsView<Dim, Storage>& bonds,
                                                    const ColumnsView<Dim * Dim>& Q, int group,
                                                    Vec<Pack, Dim>& f) {
  const int first = lanes * group;
  Pack Q_i[Dim * Dim];
  for (int k = 0; k < Dim * Dim; ++k) Q_i[k] = load(Q[k] + first);
  const auto& own = bonds.of(group);
  const auto* slots = bonds.slots(own);
  for (int b = 0; b < own.a_count; ++b) {
    Pack Q_j[Dim * Dim];
    gather(Q, first, slots[b], Q_j);
    const Vec<Pack, Dim> a_ij = unpacked(bonds.a_ij(own)[b]);
    for (int a = 0; a < Dim; ++a) {
      Pack of_bond = (Q_i[a * Dim] + Q_j[a * Dim]) * a_ij[0];
      for (int k = 1; k < Dim; ++k) of_bond += (Q_i[a * Dim + k] + Q_j[a * Dim + k]) * a_ij[k];
      f[a] += of_bond;
    }
  }
}

}  // namespace taut
