#pragma once

#include <cstddef>
#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"

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

/// Returns bonds of bodies in 3D that do not end at clamps yet, without volumes and masses. h in m.
Bonds solid_bonds(const InitialParticles& initial, const Constraints& constraints, double spacing, double h,
                  int threads);

}  // namespace taut
