#pragma once

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

/// Inner particles take differences of tensions instead of sums: σ_i·L_i becomes (σ_i + 2 R_i)·L_i, R = −σ⁺,
/// [Khayyer2024] §3.4. Linear momentum is not conserved.
namespace taut {

/// Term j of the colour function C = Σ W V_j, which includes i itself. [Khayyer2024] Eq. 52
template <class T>
T colour_term(const T& W, const T& V_j) {
  return W * V_j;
}
inline constexpr TermInfo surface_info{
    "surface", "C = Σ W V_j < 0.9, and particles within 1.2 dp of them", "[Khayyer2024] Eq. 52",
    "terms/tensile_instability_control.hpp:colour_term",
    "colour function: the value is 1 inside a lattice and below 0.9 only on its face"};

/// Force per volume on an inner particle, N/m³. [Khayyer2024] Eq. 50, 51
template <int Dim>
Vec<double, Dim> tensile_control(const Mat<double, Dim>& R_L, const Vec<double, Dim>& sum_V_gradient) {
  return 2.0 * (R_L * sum_V_gradient);
}
inline constexpr TermInfo tensile_control_info{
    "tensile control, inside", "dv/dt = Σ m_j 2 R_i·L_i/(ρ_i ρ_j)·∇W, R = −σ⁺", "[Khayyer2024] Eq. 49–51",
    "terms/tensile_instability_control.hpp:tensile_control",
    "tensile control: equal tensions exert no force"};

}  // namespace taut
