#pragma once

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Term j of a force per volume (T = σ or σ·L, w = V, [Khayyer2024] Eq. 9, 28) or an acceleration (T = σ/ρ², w = m,
/// [TranDuc2023] Eq. 2.3); also of the artificial stress, [Khayyer2024] Eq. 31.
template <class T, int Dim>
Vec<T, Dim> stress_divergence_term(const Mat<T, Dim>& T_i, const Mat<T, Dim>& T_j, const T& w_j, const T& dW,
                                   const Vec<T, Dim>& e_ij) {
  return T(w_j * dW) * ((T_i + T_j) * e_ij);
}
inline constexpr TermInfo stress_divergence_info{
    "stress divergence", "dv/dt = Σ m_j (σ_i + σ_j)/(ρ_i ρ_j)·∇W", "[Khayyer2024] Eq. 9",
    "terms/stress_divergence.hpp:stress_divergence_term",
    "stress divergence: forces are opposite, and tension attracts"};
inline constexpr TermInfo corrected_divergence_info{
    "stress divergence", "dv/dt = Σ m_j (σ_i·L_i + σ_j·L_j)/(ρ_i ρ_j)·∇W", "[Khayyer2024] Eq. 28",
    "terms/stress_divergence.hpp:stress_divergence_term",
    "stress divergence: forces are opposite, and tension attracts"};
inline constexpr TermInfo divergence_of_squares_info{
    "stress divergence", "dv/dt = Σ m_j (σ_i/ρ_i² + σ_j/ρ_j²)·∇W", "[TranDuc2023] Eq. 2.3",
    "terms/stress_divergence.hpp:stress_divergence_term",
    "stress divergence: forces are opposite, and tension attracts"};

}  // namespace taut
