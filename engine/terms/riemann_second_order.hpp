#pragma once

#include "engine/core/tensor.hpp"
#include "engine/methods/term_info.hpp"

/// Dissipation from the Riemann problem of each pair, with velocities reconstructed half way to each other:
/// it vanishes where the velocity is linear.
namespace taut::inline TAUT_ISA {

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
inline constexpr TermInfo riemann_dissipation_info{
    "Riemann term", "dv/dt = −Σ m_j p**/(ρ_i ρ_j) ∇W, p** = C_ij (u_i − u_j) reconstructed",
    "[Khayyer2024] Eq. 39–45", "terms/riemann_second_order.hpp:riemann_dissipation",
    "Riemann term: none where the velocity is linear, equal and opposite"};

}  // namespace taut::inline TAUT_ISA
