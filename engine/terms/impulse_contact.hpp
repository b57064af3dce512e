#pragma once

#include <algorithm>

#include "engine/core/pack.hpp"

namespace taut::inline TAUT_ISA {

/// Force on each of two particles of two bodies along the pair, N (per metre depth in 2D), that stops their
/// approach within one step: μ max(closing speed, 0)/dt, μ = 1/(1/m_i + 1/m_j).  [Khayyer2024] Eq. 54
/// It has no energy, but takes the pair's of the approach: two particles that meet do not bounce; bodies do,
/// by their own elasticity. A particle that meets n others at once is stopped by each of them: with the
/// normal at angles θ_k to the pairs the approach is stopped Σ cos²θ_k times. Below 2 the contact loses
/// energy still; beyond it would gain some.
/// Differs from the paper: masses come as inverse masses, 1/kg, and that of a held particle is 0 (the paper
/// has none). The paper does not say how near the particles must be: one spacing, see solver/contact.hpp.
inline double impulse_force(double closing_speed, double inv_m_i, double inv_m_j, double dt) {
  const double inv_mu = inv_m_i + inv_m_j;
  return inv_mu > 0 ? std::max(closing_speed, 0.0) / (inv_mu * dt) : 0;
}

}  // namespace taut::inline TAUT_ISA
