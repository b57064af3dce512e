#pragma once

#include <vector>

#include "engine/methods/bonded/layout/constraints.hpp"

namespace taut {

/// Plain data of a RecoveredGradient.
struct RecoveredView {
  const int *begin, *j, *row;
  const double* g;
  const float* halved;           // replaces g; else null
  const unsigned char* between;  // null: none
};

/// Gradients on the initial layout for snapshots, exact for quadratic fields up to the surface,
///   ∇f at i = Σ_j (f_j − f_i) ⊗ g_ij,   Σ_j X_ij ⊗ g_ij = I,   Σ_j X_ij ⊗ X_ij ⊗ g_ij = 0,
/// where the method's own gradient is not second-order accurate (THEORY.md, Recovered gradient).
struct RecoveredGradient {
  std::vector<int> begin;  // [n + 1] first entry of each particle; no entries: its own gradient is used
  std::vector<int> j;
  std::vector<int> row;                // [n] first of its numbers in `g`; equal neighbourhoods share them
  std::vector<double> g;               // 1/m, dim numbers each
  std::vector<float> halved;           // replaces g if requested
  std::vector<unsigned char> between;  // [n] 1: its own gradient averages two sides (3D); empty if none does
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
  /// Returns g_ij for b from begin[i] to begin[i + 1] − 1, if not halved.
  const double* of(int i, int b) const { return &g[row[i] + dim * (b - begin[i])]; }
};

/// Particle id[k] is stored at k; the result uses stored indices. `drive` is as in `initial`, or −1 once a drive has
/// ended. `reach`: of the method's own gradient, m. `halved`: for layouts in which each particle has its own row.
RecoveredGradient recovered_gradient(const InitialParticles& initial, const Constraints& constraints,
                                     const std::vector<int>& drive, const std::vector<int>& id,
                                     double spacing, double reach, int threads = 1, bool halved = false);

}  // namespace taut
