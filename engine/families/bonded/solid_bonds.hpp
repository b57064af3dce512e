#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "engine/families/bonded/bonds.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {

/// Computes bonds in 3D on request: storing the 26 bonds of a particle would take 1.5 kB.
struct SolidGeometry {
  /// Decay of a_ij with the distance (THEORY.md, Gradient).
  enum class Gradient : unsigned char { of_axes, steep, even };

  std::vector<Point> x;        // [n] m
  double spacing;              // m
  std::vector<int> irregular;  // [n] first of its weights in `weights`, or −1: weights of a lattice
  std::vector<double> weights;
  std::vector<Gradient> gradient;  // [n]
  bool off_lattice = false;  // some bonds are neither those of a cubic lattice nor of layers close to one

  /// Returns the bond from i to j, the k-th neighbour of i.
  ReferenceBond bond(int i, int j, std::size_t k) const;
};

/// Bonds of bodies in 3D, which do not end at clamps yet.
class SolidBonds {
 public:
  /// h in m
  SolidBonds(const InitialParticles& initial, const Constraints& constraints, double spacing, double h,
             int threads);

  std::span<const int> near(int i) const { return near_[i]; }
  /// Calls f(j, bond) for each bond of i.
  template <class F>
  void for_each(int i, const F& f) const {
    const std::span<const int> near = near_[i];
    for (std::size_t k = 0; k < near.size(); ++k) f(near[k], geometry_.bond(i, near[k], k));
  }
  const SolidGeometry& geometry() const { return geometry_; }
  SolidGeometry take_geometry() && { return std::move(geometry_); }

 private:
  struct Selection {  // of one particle
    std::vector<Eigen::Vector3d> X;
    std::vector<std::size_t> of;  // indices among its neighbours
    std::vector<double> w;        // weights of a lattice
  };

  bool is_irregular(int i) const { return irregular_bodies_[initial_.body[i]]; }
  Selection selection(int i) const;
  void extend_reach(double h, int threads);
  std::vector<double> own_weights(int i) const;
  void weigh_irregular(int threads);
  void choose_gradients(int threads);

  const InitialParticles& initial_;
  double spacing_;
  NeighborLists near_;  // by id
  std::vector<bool> irregular_bodies_;
  std::vector<double> reach_;  // [n] m, of the bonds that each selects; empty: all neighbours
  SolidGeometry geometry_;
};

}  // namespace taut
