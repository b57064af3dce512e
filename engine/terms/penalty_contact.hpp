#pragma once

#include <algorithm>

#include "engine/core/pack.hpp"

namespace taut::inline TAUT_ISA {

/// Force between two particles of two bodies, N (per metre depth in 2D): K dp^(d−2) (dp − r) where r < dp, 0
/// beyond. A layer of one spacing between the outermost particles of two faces resists as if it were of the
/// material; faces are in touch when their particles are one spacing apart. It acts along the pair and has
/// the energy below.
inline double penalty_force(double r, double dp, double K, int dim) {
  const double area = dim == 3 ? dp : 1;
  return K * area * std::max(dp - r, 0.0);
}

/// J (per metre depth in 2D)
inline double penalty_energy(double r, double dp, double K, int dim) {
  return 0.5 * penalty_force(r, dp, K, dim) * std::max(dp - r, 0.0);
}

}  // namespace taut::inline TAUT_ISA
