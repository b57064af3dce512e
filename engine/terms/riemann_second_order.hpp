#pragma once

#include <algorithm>
#include <cmath>

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

/// Dissipation from the Riemann problem of each pair, with velocities reconstructed half way to each other:
/// it vanishes where the velocity is linear.
namespace taut {

/// u_i − u_j along the pair, each taken half way to the other: the speed at which the pair closes without its
/// linear part, m/s. D is the symmetric part of ∇u, all that e·∇u·e sees.      [Khayyer2024] Eq. 37, 44
template <class T, int Dim>
T reconstructed_closing_speed(const T& closing_speed, const Sym<T, Dim>& D_i, const Sym<T, Dim>& D_j,
                              const T& r, const Vec<T, Dim>& e_ij) {
  return closing_speed + 0.5 * r * dot(e_ij, (D_i + D_j) * e_ij);
}

/// p** = C_ij (u_i − u_j), C_ij = (c_i ρ_i √ρ_i + c_j ρ_j √ρ_j)/(√ρ_i + √ρ_j), Pa. [Khayyer2024] Eq. 40, 41
/// `impedance` is c ρ √ρ.
/// Differs from the paper: the force is −factor · p** V_j ∇_i W with a factor of 1, as Eq. 39 implies; Eq. 43
/// prints 2, with which the highest mode of a lattice grows at the paper's CFL number of 1.
template <class T>
T riemann_dissipation(const T& closing_speed, const T& impedance_i, const T& impedance_j, const T& root_rho_i,
                      const T& root_rho_j) {
  return (impedance_i + impedance_j) / (root_rho_i + root_rho_j) * closing_speed;
}

/// Speed C_ij / (2 min ρ) for the CFL condition at a plane interface of two materials, m/s: half of the neighbours of
/// a light particle lie in the dense material and damp it at C_ij/ρ_light. Stable up to cfl · C_ij/(ρ_light c) = 1.9
/// to 2.5 at density ratios of 5 to 50 (critical-step of composite-rings-density). Equal densities give c/2, below the
/// speed of sound. Differs from [Khayyer2024], which has no such limit.
inline double riemann_step_speed(double rho_i, double c_i, double rho_j, double c_j) {
  const double root_i = std::sqrt(rho_i), root_j = std::sqrt(rho_j);
  return riemann_dissipation(1.0, c_i * rho_i * root_i, c_j * rho_j * root_j, root_i, root_j) /
         (2 * std::min(rho_i, rho_j));
}

inline constexpr TermInfo riemann_dissipation_info{
    "Riemann term", "dv/dt = −Σ m_j p**/(ρ_i ρ_j) ∇W, p** = C_ij (u_i − u_j) reconstructed",
    "[Khayyer2024] Eq. 39–45", "terms/riemann_second_order.hpp:riemann_dissipation",
    "Riemann term: a linear velocity has none, and forces are opposite"};

}  // namespace taut
