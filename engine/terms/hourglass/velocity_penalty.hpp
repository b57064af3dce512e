#pragma once

#include <cmath>

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Term j of the rate of the penalty acceleration, divided by ξ G/ρ_i, in 1/(m s). `L_sum` = L_i + L_j,
/// `slope_over_r` = (∂W/∂r)/r. [Zhang2024b]; ξ = 4 and the sign are from the sources of SPHinXsys.
template <class T, int Dim>
Vec<T, Dim> velocity_penalty_term(const Vec<T, Dim>& v_ij, const Mat<T, Dim>& L_sum, const T& V_j,
                                  const T& slope_over_r, const Vec<T, Dim>& grad_W) {
  return T(V_j * slope_over_r) * v_ij - T(0.5 * V_j) * (L_sum * grad_W);
}
inline constexpr TermInfo velocity_penalty_info{
    "penalty", "dv/dt += ∫ ξ G/ρ Σ V_j (v_ij − ½ (L_i + L_j) x_ij)/r ∂W/∂r dt", "[Zhang2024b]",
    "terms/hourglass/velocity_penalty.hpp:velocity_penalty_term",
    "velocity penalty: the penalty is 0 for a linear velocity and opposes zigzags"};

/// Part of a velocity_penalty_term along the pair. ξ = 2. Departure: the accumulated penalty rotates only with
/// `penalty_rotation`, because rotation changes linear momentum.
template <class T, int Dim>
Vec<T, Dim> central_velocity_penalty_term(const Vec<T, Dim>& penalty, const Vec<T, Dim>& e_ij) {
  return dot(penalty, e_ij) * e_ij;
}
inline constexpr TermInfo central_velocity_penalty_info{
    "penalty", "dv/dt += ∫ ξ G/ρ Σ V_j e·(v_ij − ½ (L_i + L_j) x_ij)/r ∇W dt", "[SPHinXsys2025]",
    "terms/hourglass/velocity_penalty.hpp:central_velocity_penalty_term",
    "velocity penalty: the central penalty acts along the pair and opposes zigzags"};

/// `a` after a rotation with the spin ½ (L − Lᵀ) for `dt`, by Rodrigues' formula. [SPHinXsys2025]
template <int Dim>
Vec<double, Dim> rotated_by_spin(const Mat<double, Dim>& L, const Vec<double, Dim>& a, double dt) {
  Mat<double, Dim> spin;
  double squared_angle = 0;
  for (int k = 0; k < Dim; ++k) {
    for (int l = 0; l < Dim; ++l) {
      spin(k, l) = 0.5 * dt * (L(k, l) - L(l, k));
      squared_angle += 0.5 * spin(k, l) * spin(k, l);
    }
  }
  const double angle = std::sqrt(squared_angle);
  if (angle == 0) return a;
  const double half_sine = std::sin(0.5 * angle) / (0.5 * angle);
  const Vec<double, Dim> turned = spin * a;
  return a + (std::sin(angle) / angle) * turned + (0.5 * half_sine * half_sine) * (spin * turned);
}

}  // namespace taut
