#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/core/pack.hpp"
#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Closing speed in m/s of the velocities extrapolated half way to the other particle; D: symmetric part of ∇u.
/// [Khayyer2024] Eq. 37, 44
template <class T, int Dim>
T reconstructed_closing_speed(const T& closing_speed, const Sym<T, Dim>& D_i, const Sym<T, Dim>& D_j,
                              const T& r, const Vec<T, Dim>& e_ij) {
  return closing_speed + 0.5 * r * dot(e_ij, (D_i + D_j) * e_ij);
}

/// [Khayyer2024] §3.3 has no limiter; `first_order` omits the reconstruction, Eq. 37.
enum class Limiter { none, minmod, van_leer, first_order };
inline constexpr std::string_view limiter_names[] = {"none", "minmod", "van-leer", "first-order"};

/// Limited velocity difference, m/s. `over`: over the pair; `behind`: over the same distance on the far side of one
/// particle.
template <class T>
T limited(const T& over, const T& behind, Limiter limiter) {
  const T zero = filled<T>(0), product = over * behind;
  if (limiter == Limiter::first_order) return zero;
  if (limiter == Limiter::minmod)
    return product > zero ? (over * over < behind * behind ? over : behind) : zero;
  return product > zero ? T(2.0 * product / (product > zero ? over + behind : filled<T>(1))) : zero;
}

/// Closing speed of the limited reconstruction, m/s.
template <class T, int Dim>
T limited_closing_speed(const T& closing_speed, const Sym<T, Dim>& D_i, const Sym<T, Dim>& D_j, const T& r,
                        const Vec<T, Dim>& e_ij, Limiter limiter) {
  const T over = -closing_speed;
  const auto part = [&](const Sym<T, Dim>& D) {
    return limited(over, T(2.0 * r * dot(e_ij, D * e_ij) - over), limiter);
  };
  return closing_speed + 0.5 * (part(D_i) + part(D_j));
}

/// p**, Pa, [Khayyer2024] Eq. 40, 41; `impedance` is c ρ √ρ. Departure: the force per volume is −p** V_j ∇_i W,
/// as Eq. 39 implies, without the unstable factor 2 of Eq. 43.
template <class T>
T riemann_dissipation(const T& closing_speed, const T& impedance_i, const T& impedance_j, const T& root_rho_i,
                      const T& root_rho_j) {
  return (impedance_i + impedance_j) / (root_rho_i + root_rho_j) * closing_speed;
}

/// CFL speed at a material interface, m/s: dense neighbours damp light particles. Departure: [Khayyer2024] has no such
/// limit.
inline double riemann_step_speed(double rho_i, double c_i, double rho_j, double c_j) {
  const double root_i = std::sqrt(rho_i), root_j = std::sqrt(rho_j);
  return riemann_dissipation(1.0, c_i * rho_i * root_i, c_j * rho_j * root_j, root_i, root_j) /
         (2 * std::min(rho_i, rho_j));
}

inline constexpr TermInfo riemann_dissipation_info{
    "Riemann term", "dv/dt = −Σ m_j p**/(ρ_i ρ_j) ∇W, p** = C_ij times the reconstructed closing speed",
    "[Khayyer2024] Eq. 39–45", "terms/riemann_second_order.hpp:riemann_dissipation",
    "Riemann term: a linear velocity has no dissipation, and forces are opposite"};

}  // namespace taut
