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

/// Gradients for snapshots, ∇f at i = Σ_j (f_j − f_i) ⊗ g_ij (THEORY.md, Recovered gradient).
struct RecoveredGradient {
  // [n + 1]; particles without entries keep the gradient of the method
  std::vector<int> begin;
  std::vector<int> j;
  std::vector<int> row;       // [n] first index in `g`
  std::vector<double> g;      // 1/m, dim numbers per entry
  std::vector<float> halved;  // replaces g if requested
  // [n] 1: the method's gradient averages over two materials or motions; 3D only, may be empty
  std::vector<unsigned char> between;
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
  /// begin[i] ≤ b < begin[i + 1]; not for `halved`.
  const double* of(int i, int b) const { return &g[row[i] + dim * (b - begin[i])]; }
};

/// Particle id[k] is stored at k; the result uses stored indices. `drive`: as in `initial`, but −1 after its
/// end. `reach`: support of the method's gradient, m. `halved`: stores g in single precision.
RecoveredGradient recovered_gradient(const InitialParticles& initial, const Constraints& constraints,
                                     const std::vector<int>& drive, const std::vector<int>& id,
                                     double spacing, double reach, int threads = 1, bool halved = false);

}  // namespace taut
