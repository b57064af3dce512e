#pragma once

#include <algorithm>
#include <vector>

#include "engine/core/columns.hpp"
#include "engine/families/bonded/cancelled.hpp"
#include "engine/families/bonded/packed_bonds.hpp"
#include "engine/methods/term_info.hpp"
#include "engine/solver/drives.hpp"
#include "engine/solver/state.hpp"
#include "engine/terms/bond.hpp"

namespace taut::inline TAUT_ISA {

template <int Dim, class Storage>
struct StoredBonds {
  PackedBonds<Dim, Storage> packed;
  CancelledBonds<Dim, Storage> cancelled;
};

/// Sums of the stress pass over the bonds of four particles.
template <int Dim>
struct BondSums {
  Mat<Pack, Dim> A{};      // Σ_j (x_j − x_i) ⊗ a_ij
  Vec<Pack, Dim> force{};  // N
  Pack energy{};           // J; if requested
  Pack stiffest{};         // greatest s + 1/(4s²)
};

/// Returns the sums, with damping. `places`: x and x + 3 τ v; with d = x_j − x_i and `ahead` the same of x + 3 τ v,
/// d·ahead/r0² = s + 3 τ q̇, which replaces s in 3 φ′/λ = s − ¾ − 1/(4s²). r² is at least `least_r2`, in m².
template <bool WithEnergy, int Dim, class Storage>
[[gnu::always_inline]] inline BondSums<Dim> bond_sums(const PackedBonds<Dim, Storage>& bonds,
                                                      const Columns<2 * Dim>& places, int group,
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
    Pack place[2 * Dim];              // of j
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
    "families/bonded/bond_sums.hpp:bond_sums",
    "oenog: the damping takes a zigzag away and leaves the first mode alone"};

/// Adds Σ_j (Q_i + Q_j) a_ij to the forces on four particles.
template <int Dim, class Storage>
[[gnu::always_inline]] inline void add_stress_force(const PackedBonds<Dim, Storage>& bonds,
                                                    const Columns<Dim * Dim>& Q, int group,
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

/// Clamp places as columns behind the particles. The places of a driven region follow it.
template <int Dim>
class Clamps {
 public:
  using V = Vec<double, Dim>;

  /// Resizes the columns and appends the places, where the stress is 0.
  void add_places(const std::vector<ClampPlace>& all, const State<Dim>& s, const Drives<Dim>& drives,
                  Columns<2 * Dim>& places, Columns<Dim * Dim>& Q) {
    const std::vector<int> where = stored_places(s.id);
    first_ = (s.size() + lanes - 1) / lanes * lanes;
    const int count = static_cast<int>(all.size());
    places.resize(first_ + count);
    Q.resize(first_ + count);
    for (int i = 0; i < count; ++i) {
      const int behind = behind_.emplace_back(where[all[i].behind]);
      V from_behind;
      for (int k = 0; k < Dim; ++k) {
        places[k][first_ + i] = places[Dim + k][first_ + i] = all[i].x[k];
        from_behind[k] = all[i].x[k] - s.x[behind][k];
      }
      if (drives.lasts(all[i].behind)) driven_.push_back({first_ + i, behind, from_behind});
    }
  }

  bool has_driven() const { return !driven_.empty(); }

  /// Moves the places with the driven particles behind them; `ahead`, in s, as in x + ahead v.
  void follow(const State<Dim>& s, double ahead, Columns<2 * Dim>& places) const {
    for (const auto& [place, behind, from_behind] : driven_)
      for (int k = 0; k < Dim; ++k) {
        const double x = s.x[behind][k] + from_behind[k];
        places[k][place] = x, places[Dim + k][place] = x + ahead * s.v[behind][k];
      }
  }

  /// Calls use(particle behind the place, force on the free particle, in N) for each bond into a clamp.
  template <class Storage, class Use>
  void for_each_pull(const PackedBonds<Dim, Storage>& bonds, const Columns<2 * Dim>& places,
                     const Columns<Dim * Dim>& Q, double least_r2, const Use& use) const {
    for (const auto& [group, lane, b, place] : bonds.bonds_to_clamp()) {
      const int i = lanes * group + lane, j = first_ + place;
      const auto& own = bonds.of(group);
      const auto& spring = bonds.springs(own)[b];
      V d, ahead, pull{};
      for (int k = 0; k < Dim; ++k)
        d[k] = places[k][j] - places[k][i], ahead[k] = places[Dim + k][j] - places[Dim + k][i];
      if (b < own.a_count) {
        const V a_ij = lane_of(unpacked(bonds.a_ij(own)[b]), lane);
        for (int k = 0; k < Dim; ++k)
          for (int l = 0; l < Dim; ++l) pull[k] += Q[k * Dim + l][i] * a_ij[l];
      }
      const Pack r2 = filled<Pack>(std::max(dot(d, d), least_r2));
      const double slopes =
          three_bond_slopes(dot(d, ahead) * spring.per_r02()[lane], spring.half_inverse(r2)[lane]);
      pull += (spring.third()[lane] * slopes) * d;
      use(behind_[place], pull);
    }
  }

 private:
  struct Driven {
    int place, behind;  // stored indices
    V from_behind;      // from the particle to the place, m
  };
  int first_ = 0;            // first place in the columns
  std::vector<int> behind_;  // [place] stored index of the rigid particle
  std::vector<Driven> driven_;
};

}  // namespace taut::inline TAUT_ISA
