#pragma once

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Term j of ρ_i times the shear acceleration, N/m³. [Zhang2024] Eq. 13
template <class T, int Dim>
Vec<T, Dim> nested_shear_term(const Sym<T, Dim>& s_i, const Sym<T, Dim>& s_j, const T& V_j, const T& dW,
                              const Vec<T, Dim>& e_ij) {
  return T(V_j * dW) * ((s_i + s_j) * e_ij);
}
inline constexpr TermInfo nested_shear_info{"shear force", "dv/dt = Σ m_j (s_i + s_j)/(ρ_i ρ_j)·∇W",
                                            "[Zhang2024] Eq. 13", "terms/shear.hpp:nested_shear_term",
                                            "force: the forces of j on i and of i on j are opposite"};

/// Term j of the sum in [Zhang2024] Eq. 19, 1/(m s), 0 for rigid rotation; its factor ζ = 0.7 d + 2.1 is calibrated.
template <class T, int Dim>
Vec<T, Dim> laplacian_term(const Vec<T, Dim>& v_ij, const T& V_j, const T& dW, const T& inv_r,
                           const Vec<T, Dim>& e_ij) {
  return T(2 * (V_j * dW * dot(v_ij, e_ij)) * inv_r) * e_ij;
}
inline constexpr TermInfo laplacian_info{
    "shear force", "dv/dt = ∫ 2ζ G/ρ Σ V_j (e·v_ij)/r ∇W dt", "[Zhang2024] Eq. 20",
    "terms/shear.hpp:laplacian_term",
    "laplacian: the continuum limit is (∇²v + 2 ∇∇·v)/(d + 2), and ∇²v for the plain Laplacian"};

/// Term j of ∇²v, 1/(m s), not 0 for rigid rotation. [Zhang2024] Eq. 18
template <class T, int Dim>
Vec<T, Dim> laplacian_term_nonconservative(const Vec<T, Dim>& v_ij, const T& V_j, const T& dW,
                                           const T& inv_r) {
  return T(2 * V_j * dW * inv_r) * v_ij;
}
inline constexpr TermInfo laplacian_nonconservative_info{
    "shear force", "dv/dt = ∫ 2 G/ρ Σ V_j v_ij/r ∂W/∂r dt", "[Zhang2024] Eq. 18",
    "terms/shear.hpp:laplacian_term_nonconservative",
    "laplacian: the continuum limit is (∇²v + 2 ∇∇·v)/(d + 2), and ∇²v for the plain Laplacian"};

}  // namespace taut
