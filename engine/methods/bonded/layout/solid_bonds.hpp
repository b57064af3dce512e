#pragma once

#include <cstddef>
#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"

namespace taut {

/// Computes 3D bonds on request, to save memory.
struct SolidGeometry {
  /// Decay of a_ij with the distance (THEORY.md, Gradient).
  enum class Gradient : unsigned char { of_axes, steep, even };

  std::vector<Point> x;        // [n] m
  double spacing;              // m
  std::vector<int> irregular;  // [n] first index in `weights`; −1: lattice weights
  std::vector<double> weights;
  std::vector<Gradient> gradient;  // [n]
  bool off_lattice = false;

  /// j is the k-th neighbour of i.
  ReferenceBond bond(int i, int j, std::size_t k) const;
};

/// Bonds in 3D, not yet cut at clamps, without volumes and masses. h in m.
Bonds solid_bonds(const InitialParticles& initial, const Constraints& constraints, double spacing, double h,
                  int threads);

}  // namespace taut
