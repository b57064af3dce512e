#pragma once

#include <vector>

#include "engine/scene/initial_particles.hpp"

namespace taut {

/// Gradients on the initial layout that are exact for quadratic fields, up to the surface, for what is shown:
///   ∇f at i = Σ_j (f_j − f_i) ⊗ g_ij,   Σ_j X_ij ⊗ g_ij = I,   Σ_j X_ij ⊗ X_ij ⊗ g_ij = 0.
/// A method's own gradient is exact for linear fields at most. That is as good where the neighbours stand
/// around a particle point by point, whatever weights of the distance it has, and it stands there: what is
/// shown inside a lattice is what the method feels, zigzags with it. Where they do not, at faces, clamps,
/// where materials meet, and on concentric layers, the method's own stress is off by the order of one spacing
/// times its slope, and i has a row here.
struct RecoveredGradient {
  std::vector<int> begin;  // [n + 1] of each particle; none where its own gradient stands
  std::vector<int> j;
  std::vector<int>
      row;  // [n] where in `g` its own begin: of particles with the same neighbourhood at one place
  std::vector<double> g;      // 1/m, dim numbers each
  std::vector<float> halved;  // the same in single precision, in place of g if asked for
  std::vector<unsigned char>
      between;  // [n] in 3D, 1: its own gradient is a mean of two sides, of another material or
                // of what is driven or guided; empty where none is
  int dim = 0;

  bool empty() const { return begin.empty(); }
  /// g_ij, of b from begin[i] to begin[i + 1] − 1, where it is not halved.
  const double* of(int i, int b) const { return &g[row[i] + dim * (b - begin[i])]; }
};

/// The particle that is stored at place k of the solver is id[k]; so are those of the rows. `reach` is that
/// of the method's own gradient, m.
///
/// A row is the fit of a quadratic polynomial through f_i, of least Σ r⁻⁴ |residual|², to the particles of
/// the same body and material that are held, driven or guided like i (its outermost particles as the free ones
/// beside them) and not beyond a slot, within 2.2 spacings or the least
/// reach up to 3.4 that does: in a row an error of ε in each place may cost a strain of 8 ε/dp at most, and
/// three points on a line cost 4. Where a body is too thin for that, the fit is linear, and where for that
/// too, there is none.
/// `halved`: for layouts with a row for each particle.
RecoveredGradient recovered_gradient(const InitialParticles& initial, const std::vector<int>& id,
                                     double spacing, double reach, int threads = 1, bool halved = false);

}  // namespace taut
