#pragma once

#include <algorithm>
#include <vector>

#include "engine/core/columns.hpp"
#include "engine/families/bonded/packed_bonds.hpp"
#include "engine/solver/drives.hpp"
#include "engine/solver/state.hpp"
#include "engine/terms/bond.hpp"

namespace taut::inline TAUT_ISA {

/// Where bonds end at what is held or driven to the end (bonds.hpp, Clamp). What is driven takes its places along and is
/// pulled at by them; what is held is so only where a probe asks for it.
template <int Dim>
class Clamps {
 public:
  using V = Vec<double, Dim>;

  /// Puts the places into the columns, which have no stress, past all groups of particles.
  template <class Kept>
  void add_places(const PackedBonds<Dim, Kept>& bonds, const State<Dim>& s, const Drives<Dim>& drives,
                  Columns<2 * Dim>& places, Columns<Dim * Dim>& Q) {
    first_ = (s.size() + lanes - 1) / lanes * lanes;
    const auto& all = bonds.places_at_clamp();
    const int count = static_cast<int>(all.size());
    places.resize(first_ + count);
    Q.resize(first_ + count);
    for (int i = 0; i < count; ++i) {
      const auto& [x, behind] = all[i];
      for (int k = 0; k < Dim; ++k) places[k][first_ + i] = places[Dim + k][first_ + i] = x[k];
      if (drives.lasts(s.id[behind])) driven_.push_back({first_ + i, behind, x - s.x[behind]});
    }
  }

  bool are_driven() const { return !driven_.empty(); }

  /// To where the driven particles behind them are; `ahead`, s, is that of x + ahead v.
  void follow(const State<Dim>& s, double ahead, Columns<2 * Dim>& places) const {
    for (const auto& [place, behind, away] : driven_)
      for (int k = 0; k < Dim; ++k) {
        const double x = s.x[behind][k] + away[k];
        places[k][place] = x, places[Dim + k][place] = x + ahead * s.v[behind][k];
      }
  }

  /// What bonds pull at free particles with: f(particle behind the place, force, N) for each.
  template <class Kept, class Use>
  void for_each_pull(const PackedBonds<Dim, Kept>& bonds, const Columns<2 * Dim>& places,
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
      use(bonds.places_at_clamp()[place].behind, pull);
    }
  }

 private:
  struct Driven {
    int place, behind;  // where they are stored
    V away;             // of the place from the particle, m
  };
  int first_ = 0;  // where the places begin
  std::vector<Driven> driven_;
};

}  // namespace taut::inline TAUT_ISA
