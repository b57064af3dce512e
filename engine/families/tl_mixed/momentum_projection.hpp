#pragma once

#include <vector>

#include "engine/core/tensor.hpp"
#include "engine/methods/term_info.hpp"

namespace taut::inline TAUT_ISA {

/// The accelerations nearest to `a`, in the mean square over the volume, that change neither the linear nor
/// the angular momentum of a body:  Σ V a = 0,  Σ V Z × a = 0.                          [Lee2016] Eq. 45–48
/// a_i + λ × (Z_i − Z̄) − ā, with Z̄ and ā means over the volume: the paper's system (Eq. 48) with its two
/// unknowns apart. One body is the particles first … last − 1, of one density. The sums are taken in the
/// order of the particles, so that they do not depend on the number of threads. With a share below 1 the
/// accelerations go that part of the way.
inline void project_on_momenta(std::vector<Vec<double, 2>>& a, const std::vector<Vec<double, 2>>& Z,
                               const std::vector<double>& V, int first, int last, double share = 1) {
  double volume = 0;
  Vec<double, 2> mean_a{}, mean_Z{};
  for (int i = first; i < last; ++i) {
    volume += V[i];
    mean_a += V[i] * a[i];
    mean_Z += V[i] * Z[i];
  }
  mean_a = (1 / volume) * mean_a;
  mean_Z = (1 / volume) * mean_Z;
  double torque = 0, inertia = 0;  // over the density
  for (int i = first; i < last; ++i) {
    const Vec<double, 2> z = Z[i] - mean_Z;
    torque += V[i] * (z[0] * a[i][1] - z[1] * a[i][0]);
    inertia += V[i] * dot(z, z);
  }
  const double lambda = -torque / inertia;
  for (int i = first; i < last; ++i) {
    const Vec<double, 2> z = Z[i] - mean_Z;
    a[i] += share * Vec<double, 2>{-lambda * z[1] - mean_a[0], lambda * z[0] - mean_a[1]};
  }
}

inline constexpr TermInfo projection_info{
    "projection", "forces and D(v) nearest to those with Σ V a = 0, Σ V Z × a = 0", "[Lee2016] Eq. 45–51",
    "families/tl_mixed/momentum_projection.hpp:project_on_momenta",
    "projection: the nearest accelerations without force and torque"};

}  // namespace taut::inline TAUT_ISA
