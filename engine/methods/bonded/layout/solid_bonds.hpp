#pragma once

#include <cstddef>
#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"

namespace taut {

/// Computed on request; storage would be 1.5 kB per particle.
struct SolidGeometry {
  /// See THEORY.md, Gradient.
  enum class Gradient : unsigned char { of_axes, steep, even };

  std::vector<Point> x;        // [n] m
  double spacing;              // m
  std::vector<int> irregular;  // [n] in `weights`; −1: of lattices
  std::vector<double> weights;
  std::vector<Gradient> gradient;  // [n]
  bool off_lattice = false;        // some bonds are not (nearly) cubic

  /// j is the k-th neighbour of i.
  ReferenceBond bond(int i, int j, std::size_t k) const;
};

/// Not cut at clamps, without volumes and masses. h: m.
Bonds solid_bonds(const InitialParticles& initial, const Constraints& constraints, double spacing, double h,
                  int threads);

}  // namespace taut
