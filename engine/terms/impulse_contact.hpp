#pragma once

#include <algorithm>

#include "engine/core/pack.hpp"
#include "engine/terms/contact_law_row.hpp"

namespace taut {

/// Impulse on each particle along the pair, N s: [Khayyer2024] Eq. 54 times Δt (THEORY.md). Departure: inverse
/// masses, 0 for clamped particles and along the fixed axes of rollers.
inline double stopping_impulse(double closing_speed, double inv_m_i, double inv_m_j) {
  const double inv_mu = inv_m_i + inv_m_j;
  return inv_mu > 0 ? std::max(closing_speed, 0.0) / inv_mu : 0;
}
inline constexpr ContactLawRow impulse_contact{
    .law = ContactLaw::impulse,
    .help = "impulses that stop the approach of two particles, [Khayyer2024] Eq. 53, 54",
    .term = {"contact", "Δ(m_i v_i) = m_i m_j/(m_i + m_j) · closing speed, between bodies, r < dp",
             "[Khayyer2024] Eq. 53, 54", "terms/impulse_contact.hpp:stopping_impulse",
             "impulse contact: the impulse stops an approaching pair and is 0 for a separating pair"},
    .between = ContactBetween::particles,
    .impulse = stopping_impulse,
};

}  // namespace taut
