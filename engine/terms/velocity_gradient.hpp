#pragma once

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Adds one neighbour to L = ∇v, 1/s. [Zhang2024] Eq. 14. Departure: the paper prints no minus.
template <class T, int Dim>
void add_velocity_gradient(Mat<T, Dim>& L, const T& V_j, const T& dW, const Vec<T, Dim>& v_ij,
                           const Vec<T, Dim>& e_ij) {
  add_outer(L, T(-V_j * dW), v_ij, e_ij);
}
inline constexpr TermInfo velocity_gradient_info{
    "velocity gradient", "L = −Σ V_j v_ij ⊗ ∇W", "[Zhang2024] Eq. 14",
    "terms/velocity_gradient.hpp:add_velocity_gradient",
    "velocity gradient: a linear field on irregular particles is exact after correction"};
inline constexpr TermInfo penalized_gradient_info{
    "velocity gradient", "L_i = −Σ V_j v_ij ⊗ B_i·∇W, B = (−Σ V_j x_ij ⊗ ∇W)⁻¹", "[Zhang2024b]",
    "terms/velocity_gradient.hpp:add_velocity_gradient",
    "velocity gradient: a linear field on irregular particles is exact after correction"};
inline constexpr TermInfo transported_gradient_info{
    "velocity gradient", "∇û = Σ V_j û_ji ⊗ ∇W, dρ/dt = −ρ tr ∇û", "[Khayyer2024] Eq. 8, 13",
    "terms/velocity_gradient.hpp:add_velocity_gradient",
    "velocity gradient: a linear field on irregular particles is exact after correction"};
inline constexpr TermInfo corrected_gradient_info{
    "velocity gradient", "∇û = Σ V_j û_ji ⊗ L_i·∇W, dρ/dt = −ρ tr ∇û", "[Khayyer2024] Eq. 27, 29",
    "terms/velocity_gradient.hpp:add_velocity_gradient",
    "velocity gradient: a linear field on irregular particles is exact after correction"};
inline constexpr TermInfo gradient_and_masses_info{
    "velocity gradient", "∇u = Σ V_j u_ji ⊗ ∇W, dρ/dt = Σ m_j u_ij·∇W", "[TranDuc2023] §2.2",
    "terms/velocity_gradient.hpp:add_velocity_gradient",
    "velocity gradient: a linear field on irregular particles is exact after correction"};

}  // namespace taut
