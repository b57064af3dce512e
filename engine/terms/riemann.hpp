#pragma once

#include "engine/core/pack.hpp"
#include "engine/term_info.hpp"

/// Along e_ij (from j to i), left state i: U_L = −v_i·e_ij, U_R = −v_j·e_ij. Departure: linearised, since [Zhang2024]
/// prints no formula for U* and P*.
namespace taut {

struct Dissipation {
  double rho0_c0;  // impedance, kg/(m² s)
  double slope;    // limiter/c0, s/m
  double least;    // lower bound of β
};

/// P* of [Zhang2024] Eq. 12, Pa: ½ (p_i + p_j) + ½ β ρ0 c0 (U_L − U_R). β = 1 is the linearised solver; the solver that
/// the paper cites has β = min(3 max(U_L − U_R, 0)/c0, 1).
template <class T>
T riemann_pressure(const T& p_i, const T& p_j, const T& closing_speed, const Dissipation& d) {
  T impedance = filled<T>(d.rho0_c0);
  if (d.least < 1) impedance *= min(max(d.slope * closing_speed, filled<T>(d.least)), filled<T>(1));
  return 0.5 * (p_i + p_j + impedance * closing_speed);
}
inline constexpr TermInfo riemann_pressure_info{"pressure force", "dv/dt = −2 Σ m_j P*/(ρ_i ρ_j) ∇W",
                                                "[Zhang2024] Eq. 12", "terms/riemann.hpp:riemann_pressure",
                                                "riemann: P* is symmetric in the two states"};

/// Term j of (dρ_i/dt)/ρ_i without the pressures in U*, 1/s. [Zhang2024] Eq. 11
template <class T>
T compression_term(const T& V_j, const T& dW, const T& closing_speed) {
  return -V_j * dW * closing_speed;
}
inline constexpr TermInfo compression_info{
    "continuity", "dρ/dt = ρ_i Σ V_j v_ij·∇W", "[Zhang2024] Eq. 11", "terms/riemann.hpp:compression_term",
    "riemann: approaching pairs grow denser, and rotating pairs do not"};

/// Term of the pressures in U* of Eq. 11, 1/s. Departure: share = 0 by default, as in the authors' program, since the
/// term softens bending.
template <class T>
T pressure_diffusion_term(const T& V_j, const T& dW, const T& p_i, const T& p_j, double share, double rho0,
                          double c0) {
  return (share / (rho0 * c0)) * V_j * dW * (p_i - p_j);
}

}  // namespace taut
