#pragma once

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

}  // namespace taut
