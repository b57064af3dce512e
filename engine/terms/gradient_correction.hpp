#pragma once

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

/// L_i·∇_i W replaces ∇_i W.
namespace taut {

/// Adds one neighbour to M = −Σ V_j r_ij ⊗ ∇_i W. [Zhang2024] Eq. 27. Departure: the paper prints no minus.
template <class T, int Dim>
void add_gradient_moment(Sym<T, Dim>& M, const T& V_j, const T& dW, const T& r, const Vec<T, Dim>& e_ij) {
  add_outer(M, T(-V_j * dW * r), e_ij);
}
/// For display, in methods that do not carry stress.
inline constexpr TermInfo stress_recovery_info{
    "stress shown", "s = ∫ 2G dev D + rotation dt, corrected gradient", "[Zhang2024] Eq. 26, 27",
    "terms/gradient_correction.hpp:add_gradient_moment",
    "velocity gradient: a linear field on irregular particles is exact after correction"};

/// Least allowed det M/(tr M)^Dim.
template <int Dim>
inline constexpr double least_moment = Dim == 2 ? 1e-2 : 1e-3;

/// L = M⁻¹; 0 below `least_moment`. Departure: without this bound bent rows of particles diverge.
template <int Dim>
Sym<double, Dim> gradient_correction(const Sym<double, Dim>& M) {
  double scale = trace(M);
  for (int k = 1; k < Dim; ++k) scale *= trace(M);
  return determinant(full(M)) > least_moment<Dim> * scale ? inverse(M) : Sym<double, Dim>{};
}
inline constexpr TermInfo gradient_correction_info{
    "gradient correction", "L = (−Σ V_j r_ij ⊗ ∇W)⁻¹", "[Khayyer2024] §3.1",
    "terms/gradient_correction.hpp:gradient_correction",
    "gradient correction: gradients of linear fields are exact at a surface"};

}  // namespace taut
