#pragma once

#include <algorithm>
#include <cmath>

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Closing speed of the velocities reconstructed half way to the other particle, m/s; D: symmetric part of ∇u.
/// [Khayyer2024] Eq. 37, 44
template <class T, int Dim>
T reconstructed_closing_speed(const T& closing_speed, const Sym<T, Dim>& D_i, const Sym<T, Dim>& D_j,
                              const T& r, const Vec<T, Dim>& e_ij) {
  return closing_speed + 0.5 * r * dot(e_ij, (D_i + D_j) * e_ij);
}

/// p**, Pa, [Khayyer2024] Eq. 40, 41; `impedance` is c ρ √ρ. Departure: the force is −p** V_j ∇_i W, as Eq. 39
/// implies, without the unstable factor 2 of Eq. 43.
template <class T>
T riemann_dissipation(const T& closing_speed, const T& impedance_i, const T& impedance_j, const T& root_rho_i,
                      const T& root_rho_j) {
  return (impedance_i + impedance_j) / (root_rho_i + root_rho_j) * closing_speed;
}

/// CFL speed at a material interface, m/s: dense neighbours damp light particles. Departure: [Khayyer2024] has no
/// such limit.
inline double riemann_step_speed(double rho_i, double c_i, double rho_j, double c_j) {
  const double root_i = std::sqrt(rho_i), root_j = std::sqrt(rho_j);
  return riemann_dissipation(1.0, c_i * rho_i * root_i, c_j * rho_j * root_j, root_i, root_j) /
         (2 * std::min(rho_i, rho_j));
}

inline constexpr TermInfo riemann_dissipation_info{
    "Riemann term", "dv/dt = −Σ m_j p**/(ρ_i ρ_j) ∇W, p** = C_ij (u_i − u_j) reconstructed",
    "[Khayyer2024] Eq. 39–45", "terms/riemann_second_order.hpp:riemann_dissipation",
    "Riemann term: a linear velocity has no dissipation, and forces are opposite"};

}  // namespace taut
