#pragma once

#include <cstddef>
#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"

namespace taut {

/// Computes bonds on request, because storage would be 1.5 kB per particle.
struct SolidGeometry {
  /// Decay of a_ij (THEORY.md, Gradient).
  enum class Gradient : unsigned char { of_axes, steep, even };

  std::vector<Point> x;        // [n] m
  double spacing;              // m
  std::vector<int> irregular;  // [n] first of `weights`; −1: lattice weights
  std::vector<double> weights;
  std::vector<Gradient> gradient;  // [n]
  bool off_lattice = false;        // some layouts are not (nearly) cubic

  /// Returns the bond to j, the k-th neighbour of i.
  ReferenceBond bond(int i, int j, std::size_t k) const;
};

/// Returns 3D bonds, not cut at clamps, without volumes and masses. h in m.
Bonds solid_bonds(const InitialParticles& initial, const Constraints& constraints, double spacing, double h,
                  int threads);

}  // namespace taut
