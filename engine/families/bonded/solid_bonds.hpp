#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "engine/families/bonded/bonds.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {

/// Bonds of bodies in 3D, as if nothing were held: made when they are asked for, since a particle of a lattice
/// that kept its 26 would take 1.5 kB.
class SolidBonds {
 public:
  /// h in m
  SolidBonds(const InitialParticles& initial, double spacing, double h, int threads);

  /// f(j, bond) of each bond of i
  template <class F>
  void for_each(int i, const F& f) const {
    const std::span<const int> near = near_[i];
    for (std::size_t k = 0; k < near.size(); ++k) f(near[k], bond(i, near[k], k));
  }
  /// Whether some lie otherwise than on a cubic lattice or layers that are nearly one.
  bool off_lattice() const { return !reach_.empty(); }

 private:
  struct Asked {  // of a particle
    std::vector<Eigen::Vector3d> X;
    std::vector<std::size_t> of;  // which of those that are near
    std::vector<double> w;        // those of a lattice
  };

  bool lies_irregular(int i) const { return lies_irregular_[initial_.body[i]]; }
  Bond bond(int i, int j, std::size_t k) const;
  Asked asked(int i) const;
  void look_further(double h, int threads);
  std::vector<double> own_weights(int i) const;
  void weigh_irregular(int threads);
  void help_who_lack_an_axis(int threads);

  const InitialParticles& initial_;
  double spacing_;
  NeighborLists near_;                // by id
  std::vector<bool> lies_irregular_;  // [body]
  std::vector<double> reach_;         // [n] m, of the bonds each has asked for; empty: they all ask for all
  std::vector<int> irregular_;   // [n] where in `weights_` those of a particle begin that does not have the
  std::vector<double> weights_;  // weights of a lattice; −1 of all others
  std::vector<unsigned char> helped_;  // [n]
};

}  // namespace taut
