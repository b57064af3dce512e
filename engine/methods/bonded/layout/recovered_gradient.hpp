#pragma once

#include <vector>

#include "engine/methods/bonded/layout/constraints.hpp"

namespace taut {

struct RecoveredView {
  const int *begin, *j, *row;
  const double* g;
  const float* halved;           // or null: replaces g
  const unsigned char* between;  // null: none
};

/// Exact for quadratic fields where the own gradient is not (THEORY.md, Recovered gradient):
///   ∇f at i = Σ_j (f_j − f_i) ⊗ g_ij,   Σ_j X_ij ⊗ g_ij = I,   Σ_j X_ij ⊗ X_ij ⊗ g_ij = 0.
struct RecoveredGradient {
  std::vector<int> begin;  // [n + 1]; own gradient if empty
  std::vector<int> j;
  std::vector<int> row;                // [n] in `g`; may be shared
  std::vector<double> g;               // 1/m, dim each
  std::vector<float> halved;           // replaces g
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
  /// g_ij, begin[i] ≤ b < begin[i + 1].
  const double* of(int i, int b) const { return &g[row[i] + dim * (b - begin[i])]; }
};

/// `id` in storage order; `drive`: −1 after its end; `reach`: of the own gradient, m; `halved`: no shared rows.
RecoveredGradient recovered_gradient(const InitialParticles& initial, const Constraints& constraints,
                                     const std::vector<int>& drive, const std::vector<int>& id,
                                     double spacing, double reach, int threads = 1, bool halved = false);

}  // namespace taut
