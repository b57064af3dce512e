#pragma once

#include <algorithm>

#include "engine/core/pack.hpp"
#include "engine/terms/contact_law_row.hpp"

namespace taut {

/// Impulse on each of two particles along the pair, N s (per metre depth in 2D), that stops their approach: μ
/// max(closing speed, 0), μ = 1/(1/m_i + 1/m_j). [Khayyer2024] Eq. 54 times Δt. It dissipates the pair's approach;
/// bodies rebound by their elasticity. Among several pairs at angles θ_k to the normal the approach is stopped Σ
/// cos²θ_k times, which would add energy above 2. Departure: inverse masses, 1/kg; 0 for clamped particles. See
/// contact/pair_contacts.hpp for the time in a step and the distance.
inline double stopping_impulse(double closing_speed, double inv_m_i, double inv_m_j) {
  const double inv_mu = inv_m_i + inv_m_j;
  return inv_mu > 0 ? std::max(closing_speed, 0.0) / inv_mu : 0;
}
inline constexpr ContactLawRow impulse_contact{
    .law = ContactLaw::impulse,
    .help = "impulses that stop the approach of two particles, [Khayyer2024] Eq. 53, 54",
    .term = {"contact", "Δ(m_i v_i) = m_i m_j/(m_i + m_j) · closing speed, between bodies, r < dp",
             "[Khayyer2024] Eq. 53, 54", "terms/impulse_contact.hpp:stopping_impulse",
             "impulse contact: stops the approach of a pair, nothing else"},
    .between = ContactBetween::particles,
    .impulse = stopping_impulse,
};

}  // namespace taut
