#pragma once

#include "engine/core/pack.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Π, m⁵/(kg s²). `approach` = −u·r, m²/s. Departure: [TranDuc2023] §2.2 prints Π without 1/ρ̄ and does not state 0.01.
template <class T>
T artificial_viscosity(const T& approach, const T& r2, const T& c_mean, const T& rho_mean, double alpha,
                       double h) {
  return -alpha * h * c_mean * max(approach, T{}) / (rho_mean * (r2 + 0.01 * h * h));
}
inline constexpr TermInfo artificial_viscosity_info{
    "artificial viscosity", "dv/dt = Σ m_j Π ∇W, Π = α h c̄/ρ̄ u·r/(r² + 0.01 h²) for approaching pairs",
    "[Khayyer2024] Eq. 15, 16", "terms/artificial_viscosity.hpp:artificial_viscosity",
    "artificial viscosity: [Khayyer2024] Eq. 16 slows approaching pairs, but no separating pairs"};

}  // namespace taut
