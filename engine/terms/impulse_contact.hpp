#pragma once

#include <algorithm>

#include "engine/core/pack.hpp"
#include "engine/terms/contact_law_row.hpp"

namespace taut {

/// Impulse on each of two particles of two bodies along the pair, N s (per metre depth in 2D), that stops
/// their approach: μ max(closing speed, 0), μ = 1/(1/m_i + 1/m_j).  [Khayyer2024] Eq. 54 times Δt
/// It has no energy, but takes the pair's of the approach: two particles that meet do not bounce; bodies do,
/// by their own elasticity. A particle that meets n others at once is stopped by each of them: with the
/// normal at angles θ_k to the pairs the approach is stopped Σ cos²θ_k times. Below 2 the contact loses
/// energy still; beyond it would gain some.
/// Differs from the paper: masses come as inverse masses, 1/kg, and that of a held particle is 0 (the paper
/// has none). Where in a step it acts and how near the particles are: see contact/pair_contacts.hpp.
inline double stopping_impulse(double closing_speed, double inv_m_i, double inv_m_j) {
  const double inv_mu = inv_m_i + inv_m_j;
  return inv_mu > 0 ? std::max(closing_speed, 0.0) / inv_mu : 0;
}
inline constexpr ContactLawRow impulse_contact{
    .law = ContactLaw::impulse,
    .help = "impulses that stop the approach of two particles, [Khayyer2024] Eq. 53, 54",
    .term = {"contact", "Δ(m_i v_i) = m_i m_j/(m_i + m_j) · closing speed, between bodies, r < dp",
             "[Khayyer2024] Eq. 53, 54", "terms/impulse_contact.hpp:stopping_impulse",
             "impulse contact: the impulse stops the approach of a pair and changes nothing else"},
    .between = ContactBetween::particles,
    .impulse = stopping_impulse,
};

}  // namespace taut
