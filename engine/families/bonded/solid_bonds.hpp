#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "engine/families/bonded/bonds.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {

/// What a bond in 3D is, by where its ends are: made whenever it is asked for, since a particle that kept its 26
/// would take 1.5 kB.
struct SolidGeometry {
  enum class Gradient : unsigned char {
    of_axes,
    steep,
    even
  };  // how a_ij falls with the distance (bonds.hpp)

  std::vector<Point> x;            // [n] m
  double spacing;                  // m
  std::vector<int> irregular;      // [n] where in `weights` those of a particle begin that does not have the
  std::vector<double> weights;     // weights of a lattice; −1 of all others
  std::vector<Gradient> gradient;  // [n] that a particle needs
  bool off_lattice = false;        // some lie otherwise than on a cubic lattice or layers that are nearly one

  /// From i to j, the k-th of those that are near i.
  Bond bond(int i, int j, std::size_t k) const;
};

/// Bonds of bodies in 3D, as if nothing were held.
class SolidBonds {
 public:
  /// h in m
  SolidBonds(const InitialParticles& initial, double spacing, double h, int threads);

  std::span<const int> near(int i) const { return near_[i]; }
  /// f(j, bond) of each bond of i
  template <class F>
  void for_each(int i, const F& f) const {
    const std::span<const int> near = near_[i];
    for (std::size_t k = 0; k < near.size(); ++k) f(near[k], geometry_.bond(i, near[k], k));
  }
  const SolidGeometry& geometry() const { return geometry_; }
  SolidGeometry take_geometry() && { return std::move(geometry_); }

 private:
  struct Asked {  // of a particle
    std::vector<Eigen::Vector3d> X;
    std::vector<std::size_t> of;  // which of those that are near
    std::vector<double> w;        // those of a lattice
  };

  bool lies_irregular(int i) const { return lies_irregular_[initial_.body[i]]; }
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
  SolidGeometry geometry_;
};

}  // namespace taut
