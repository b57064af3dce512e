#pragma once

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// (ρ_j − ρ_i) V_j ∇_i W: its sum over j, times L_i, is ∇ρ, kg/m⁴.              [Khayyer2024] Eq. 35
template <class T, int Dim>
Vec<T, Dim> density_gradient_term(const T& rho_i, const T& rho_j, const T& V_j, const T& dW,
                                  const Vec<T, Dim>& e_ij) {
  return T((rho_j - rho_i) * V_j * dW) * e_ij;
}

/// ψ_ij (r·∇_i W)/r² V_j with ψ_ij = 2 (ρ_j − ρ_i) − (∇ρ_i + ∇ρ_j)·(x_j − x_i): its sum over j, times δ h c0,
/// is a rate of density; kg/m⁵ here. [Khayyer2024] Eq. 33, 34 It vanishes where ρ is linear.
/// Differs from the paper in notation: its ρ_ij is a mean in Eq. 16 and this difference in Eq. 34.
template <class T, int Dim>
T density_diffusion_term(const T& rho_i, const T& rho_j, const Vec<T, Dim>& gradient_i,
                         const Vec<T, Dim>& gradient_j, const T& V_j, const T& dW, const T& r,
                         const Vec<T, Dim>& e_ij) {
  const T psi = 2 * (rho_j - rho_i) + r * dot(gradient_i + gradient_j, e_ij);
  return -psi * dW / r * V_j;
}
inline constexpr TermInfo density_diffusion_info{
    "density diffusion", "dρ/dt = δ h c0 Σ ψ_ij (r·∇W)/r² V_j", "[Khayyer2024] Eq. 32–35",
    "terms/density_diffusion.hpp:density_diffusion_term",
    "density diffusion: a linear density has none, others flow from dense to thin"};

}  // namespace taut
