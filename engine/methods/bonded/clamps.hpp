#pragma once

#include <algorithm>
#include <vector>

#include "engine/core/columns.hpp"
#include "engine/methods/bonded/packed_bonds.hpp"
#include "engine/solver/drives.hpp"
#include "engine/solver/particles.hpp"
#include "engine/terms/bond.hpp"

namespace taut {

/// Points where bonds into rigid regions end (THEORY.md, Clamps), in columns after the particles.
template <int Dim>
class Clamps {
 public:
  using V = Vec<double, Dim>;

  void add_places(const std::vector<ClampPlace>& all, const Particles<Dim>& s, const Drives<Dim>& drives,
                  Columns<2 * Dim>& places, Columns<Dim * Dim>& Q) {
    const std::vector<int> where = stored_places(s.id);
    first_ = (s.size() + lanes - 1) / lanes * lanes;
    const int count = static_cast<int>(all.size());
    places.resize(first_ + count);
    Q.resize(first_ + count);
    for (int i = 0; i < count; ++i) {
      const int rigid_particle = rigid_particle_.emplace_back(where[all[i].rigid_particle]);
      V from_rigid_particle;
      for (int k = 0; k < Dim; ++k) {
        places[k][first_ + i] = places[Dim + k][first_ + i] = all[i].x[k];
        from_rigid_particle[k] = all[i].x[k] - s.x[rigid_particle][k];
      }
      if (drives.lasts(all[i].rigid_particle))
        driven_.push_back({first_ + i, rigid_particle, from_rigid_particle});
    }
  }

  bool has_driven() const { return !driven_.empty(); }

  /// `ahead`: 3 τ in s.
  void follow(const Particles<Dim>& s, double ahead, const ColumnsView<2 * Dim>& places) const {
    for (const auto& [place, rigid_particle, from_rigid_particle] : driven_)
      for (int k = 0; k < Dim; ++k) {
        const double x = s.x[rigid_particle][k] + from_rigid_particle[k];
        places[k][place] = x, places[Dim + k][place] = x + ahead * s.v[rigid_particle][k];
      }
  }

  /// Calls use(stored index of the rigid particle, force on the free particle in N).
  template <class Storage, class Use>
  void for_each_pull(const PackedBonds<Dim, Storage>& packed, const ColumnsView<2 * Dim>& places,
                     const ColumnsView<Dim * Dim>& Q, double least_r2, const Use& use) const {
    const auto bonds = packed.view();
    for (const auto& [group, lane, b, place] : packed.bonds_to_clamp()) {
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
      use(rigid_particle_[place], pull);
    }
  }

 private:
  struct Driven {
    int place, rigid_particle;  // index in the columns; stored index
    V from_rigid_particle;      // m
  };
  int first_ = 0;                    // index of the first place
  std::vector<int> rigid_particle_;  // [place] stored index
  std::vector<Driven> driven_;
};

}  // namespace taut
