#pragma once

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Term j of the uncorrected density gradient, kg/m⁴; ∇ρ is L_i times the sum. [Khayyer2024] Eq. 35
template <class T, int Dim>
Vec<T, Dim> density_gradient_term(const T& rho_i, const T& rho_j, const T& V_j, const T& dW,
                                  const Vec<T, Dim>& e_ij) {
  return T((rho_j - rho_i) * V_j * dW) * e_ij;
}

/// Term j of the diffusion, kg/m⁵; 0 for linear ρ. [Khayyer2024] Eq. 34, where ρ_ij is a difference.
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
    "density diffusion: a linear density does not diffuse, others flow from dense to thin"};

}  // namespace taut
