#pragma once

#include "engine/core/pack.hpp"
#include "engine/term_info.hpp"

/// The low-dissipation Riemann problem of a pair along e_ij (from j to i), with the left state i:
///   U_L = −v_i·e_ij,  U_R = −v_j·e_ij,  so U_L − U_R = −v_ij·e_ij is the speed at which the pair closes.
/// [Zhang2024] prints neither U* nor P*; they are those of a linearised solver with a limited dissipation.
namespace taut {

/// The dissipation in P*.
struct Dissipation {
  double rho0_c0;  // impedance, kg/(m² s)
  double slope;    // limiter/c0, s/m
  double least;    // least β
};

/// P* = ½ (p_i + p_j) + ½ β ρ0 c0 (U_L − U_R)                                  [Zhang2024] Eq. 12
/// Pa, symmetric in i and j. β = 1 is the linearised solver; the low-dissipation limiter of the reference
/// that the paper names is β = min(3 max(U_L − U_R, 0)/c0, 1), here β_least = 0. [Zhang2024] prints no β.
/// With the limiter `og` zigzags and tears at the published times, but `enog` gains energy on the oscillating
/// plate (v_f = 0.05) from its second period on and is lost at 0.6 s, where the paper shows 30 steady
/// periods, and `oas` is lost before its first. With β = 1 `enog` and `oas` are steady as published, but `og`
/// tears only at 0.1 s instead of 0.02 s. So `og` is limited and the others are not.
template <class T>
T riemann_pressure(const T& p_i, const T& p_j, const T& closing_speed, const Dissipation& d) {
  T impedance = filled<T>(d.rho0_c0);
  if (d.least < 1) impedance *= min(max(d.slope * closing_speed, filled<T>(d.least)), filled<T>(1));
  return 0.5 * (p_i + p_j + impedance * closing_speed);
}
inline constexpr TermInfo riemann_pressure_info{"pressure force", "dv/dt = −2 Σ m_j P*/(ρ_i ρ_j) ∇W",
                                                "[Zhang2024] Eq. 12", "terms/riemann.hpp:riemann_pressure",
                                                "riemann: P* is symmetric in the two states"};

/// V_j · 2 (U* + v_i·e_ij) ∂W/∂r with U* = ½ (U_L + U_R), that is V_j (v_ij·e_ij) ∂W/∂r: its sum over j times
/// ρ_i is dρ_i/dt, in 1/s.                                                      [Zhang2024] Eq. 11
/// Differs from the paper: its U* carries (p_i − p_j)/(2 ρ0 c0) too, which is `pressure_diffusion_term`.
template <class T>
T compression_term(const T& V_j, const T& dW, const T& closing_speed) {
  return -V_j * dW * closing_speed;
}
inline constexpr TermInfo compression_info{"continuity", "dρ/dt = ρ_i Σ V_j v_ij·∇W", "[Zhang2024] Eq. 11",
                                           "terms/riemann.hpp:compression_term",
                                           "riemann: approaching pairs grow denser, whatever their order"};

/// The remaining part of U*: V_j · 2 · share (p_i − p_j)/(2 ρ0 c0) ∂W/∂r, in 1/s.  [Zhang2024] Eq. 11
/// Left out by default (share = 0), as in the authors' own implementation: it diffuses the pressure gradient
/// of a bent plate away and lengthens its period by a fifth.
template <class T>
T pressure_diffusion_term(const T& V_j, const T& dW, const T& p_i, const T& p_j, double share, double rho0,
                          double c0) {
  return (share / (rho0 * c0)) * V_j * dW * (p_i - p_j);
}

}  // namespace taut
