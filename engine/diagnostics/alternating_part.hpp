#pragma once

#include <vector>

#include "engine/snapshot.hpp"

namespace taut {

/// The part of a field that alternates from particle to particle, at each particle i that has enough others
/// around it: r_i = Σ_j w_ij q_j, over i and the particles j of its own body and material, held or not as i
/// is, at most 2.1 dp away at the start. The weights belong to the initial configuration, so they are known
/// before the run, mean the same to every method, and are not led astray by contact or torn bodies.
///
/// w_i is i's own unit vector less its projection P on the quadratic polynomials over these particles,
/// scaled:
///   w_i = κ (I − P) e_i / |(I − P) e_i|
/// Every quadratic field thus gives 0, at a surface as well as inside; what is left of a smooth field is
/// O(dp⁴) inside and O(dp³) at a surface. Each row responds alike to a field without any order: noise of
/// variance 1 gives κ². κ is such that the checkerboard (−1)^(a+b+c) on a square or cubic lattice gives
/// itself; in 2D the modes (−1)^a and (−1)^b then do so too. A surface row does not feel the mode that
/// alternates across it (three rows are in reach, which a parabola fits); the row below it does.
///
/// Held particles, corners and others with too few around them for more than the parabola have no row.
struct AlternatingPart {
  std::vector<int> begin;         // [rows + 1] first entry of each row
  std::vector<int> j;             // particle of each entry
  std::vector<int> first_weight;  // of each row; in 3D rows of the same surroundings share theirs
  std::vector<double> weight;
  int rows() const { return static_cast<int>(begin.size()) - 1; }
  /// w_ij of the entries of a row
  const double* weights(int row) const {
    return &weight[static_cast<std::size_t>(first_weight[static_cast<std::size_t>(row)])];
  }
};

AlternatingPart alternating_part(const Snapshot& start, double spacing, int threads = 1);

/// Sums of squares: of a length in m², of p and of the von Mises stress in Pa².
struct SquareSums {
  double x = 0, p = 0, von_mises = 0;
};
/// Over the particles that have a row.
struct AlternatingSums {
  std::vector<double> x;  // [row] squares of the alternating parts, with one spacing at most, m²
  SquareSums part;        // of the alternating parts; a length counts with one spacing at most
  SquareSums whole;       // of the particles themselves, but for their places
};
AlternatingSums alternating_sums(const AlternatingPart& part, const Snapshot& now, double spacing);

}  // namespace taut
