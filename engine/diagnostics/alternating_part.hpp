#pragma once

#include <vector>

#include "engine/snapshot.hpp"

namespace taut {

/// Alternating part of a field at each particle i with enough neighbours: r_i = Σ_j w_ij q_j over i and the particles
/// j of its body and material, clamped or not like i, initially at most 2.1 dp away. The weights depend only on the
/// initial configuration, so they suit every method and ignore contact and cracks:
///   w_i = κ (I − P) e_i / |(I − P) e_i|
/// with e_i the unit vector of i and P the projection on quadratic polynomials. Quadratic fields give 0, smooth
/// fields O(dp⁴) inside and O(dp³) at surfaces. Noise of variance 1 gives κ². κ makes the checkerboard (−1)^(a+b+c)
/// on a lattice give itself. A surface row does not detect the mode that alternates across the surface; the next row
/// does.
/// Clamped particles, and particles with too few neighbours for the fit (corners), have no row.
struct AlternatingPart {
  std::vector<int> begin;         // [row + 1] first entry
  std::vector<int> j;             // [entry] particle
  std::vector<int> first_weight;  // [row]; in 3D rows with equal surroundings share weights
  std::vector<double> weight;
  int rows() const { return static_cast<int>(begin.size()) - 1; }
  /// w_ij for the entries of a row.
  const double* weights(int row) const {
    return &weight[static_cast<std::size_t>(first_weight[static_cast<std::size_t>(row)])];
  }
};

AlternatingPart alternating_part(const Snapshot& start, double spacing, int threads = 1);

/// Sums of squares: of x in m², of p and von Mises stress in Pa².
struct SquareSums {
  double x = 0, p = 0, von_mises = 0;
};
/// Over the particles that have a row.
struct AlternatingSums {
  SquareSums part;   // alternating parts; x counts at most one spacing each
  SquareSums whole;  // the fields themselves; x is 0
};
AlternatingSums alternating_sums(const AlternatingPart& part, const Snapshot& now, double spacing);

}  // namespace taut
