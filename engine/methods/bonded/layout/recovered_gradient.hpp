#pragma once

#include <vector>

#include "engine/methods/bonded/layout/constraints.hpp"

namespace taut {

struct RecoveredView {
  const int *begin, *j, *row;
  const double* g;
  const float* halved;           // replaces g unless null
  const unsigned char* between;  // null: none
};

/// Gradients for snapshots, exact for quadratic fields (THEORY.md, Recovered gradient):
///   ∇f at i = Σ_j (f_j − f_i) ⊗ g_ij,   Σ_j X_ij ⊗ g_ij = I,   Σ_j X_ij ⊗ X_ij ⊗ g_ij = 0.
struct RecoveredGradient {
  std::vector<int> begin;  // [n + 1]; empty: own gradient
  std::vector<int> j;
  std::vector<int> row;                // [n] first index in `g`, may be shared
  std::vector<double> g;               // 1/m, dim each
  std::vector<float> halved;           // replaces g if requested
  std::vector<unsigned char> between;  // [n] 1: the own gradient averages two sides
  int dim = 0;

  bool empty() const { return begin.empty(); }
  RecoveredView view() const {
    return {begin.data(),
            j.data(),
            row.data(),
            g.data(),
            halved.empty() ? nullptr : halved.data(),
            between.empty() ? nullptr : between.data()};
  }
  /// Returns g_ij for begin[i] ≤ b < begin[i + 1].
  const double* of(int i, int b) const { return &g[row[i] + dim * (b - begin[i])]; }
};

/// `id`: storage order; `drive`: −1 once ended; `reach` of the own gradient, m; `halved`: for rows that are not
/// shared.
RecoveredGradient recovered_gradient(const InitialParticles& initial, const Constraints& constraints,
                                     const std::vector<int>& drive, const std::vector<int>& id,
                                     double spacing, double reach, int threads = 1, bool halved = false);

}  // namespace taut
