#pragma once

#include <vector>

#include "engine/snapshot.hpp"

namespace taut {

/// Alternating part r_i = Σ_j w_ij q_j (THEORY.md).
struct AlternatingPart {
  std::vector<int> begin;         // [row + 1] first entry
  std::vector<int> j;             // [entry] particle
  std::vector<int> first_weight;  // equal rows may share weights
  std::vector<double> weight;
  int rows() const { return static_cast<int>(begin.size()) - 1; }
  const double* weights(int row) const {
    return &weight[static_cast<std::size_t>(first_weight[static_cast<std::size_t>(row)])];
  }
};

AlternatingPart alternating_part(const Snapshot& start, double spacing, int threads = 1);

/// m² and Pa².
struct SquareSums {
  double x = 0, p = 0, von_mises = 0;
};
/// Sums over particles with a row.
struct AlternatingSums {
  std::vector<double> x;  // [row] square of the alternating part of x, at most spacing², m²
  SquareSums part;        // of the alternating parts
  SquareSums whole;       // of the fields; x is 0
};
AlternatingSums alternating_sums(const AlternatingPart& part, const Snapshot& now, double spacing);

}  // namespace taut
