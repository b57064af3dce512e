#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/families/bonded/bonds.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {

/// Bonds of a cubic lattice, as if nothing were held: made when they are asked for, since a particle that kept
/// its 26 would take 1.5 kB.
class LatticeBonds {
 public:
  /// h in m
  LatticeBonds(const InitialParticles& initial, double spacing, double h, int threads);

  /// f(j, bond) of each bond of i
  template <class F>
  void for_each(int i, const F& f) const {
    const std::span<const int> near = near_[i];
    for (std::size_t k = 0; k < near.size(); ++k) f(near[k], bond(i, near[k], k));
  }

 private:
  Bond bond(int i, int j, std::size_t k) const;
  void weigh_irregular(int threads);
  void help_who_lack_an_axis(int threads);

  const InitialParticles& initial_;
  double spacing_;
  NeighborLists near_;           // by id
  std::vector<int> irregular_;   // [n] of particles with 26 that do not stand as on a lattice, where their
  std::vector<double> weights_;  // weights begin; −1 of all others
  std::vector<unsigned char> helped_;  // [n]
};

}  // namespace taut
