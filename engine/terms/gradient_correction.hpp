#pragma once

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

/// The kernel gradient is corrected so that the gradient of a linear field is exact, L_i·∇_i W in place of
/// ∇_i W.
namespace taut {

/// M = −Σ V_j r_ij ⊗ ∇_i W: adds the part of one neighbour, dimensionless.
/// [Zhang2024] Eq. 27, with the sign of Eq. 14 (terms/velocity_gradient.hpp); [Khayyer2024] §3.1 takes it
/// from its reference 43
template <class T, int Dim>
void add_gradient_moment(Sym<T, Dim>& M, const T& V_j, const T& dW, const T& r, const Vec<T, Dim>& e_ij) {
  add_outer(M, T(-V_j * dW * r), e_ij);
}
/// In what is recovered to be shown.
inline constexpr TermInfo stress_recovery_info{
    "stress shown", "s = ∫ 2G dev D + rotation dt, corrected gradient", "[Zhang2024] Eq. 26, 27",
    "terms/gradient_correction.hpp:add_gradient_moment",
    "velocity gradient: a linear field on irregular particles is exact after correction"};

/// Of det M over its trace to the power of Dim, ¼ and 1/27 inside a lattice. Below this the neighbours as good as
/// lie on one line, in 3D in one plane, and what M⁻¹ makes of the little that there is across it grows without limit.
template <int Dim>
inline constexpr double least_moment = Dim == 2 ? 1e-2 : 1e-3;

/// L = M⁻¹; 0 where M has no inverse worth the name, as for a particle without neighbours, or with all of them about in
/// one line. Differs from [Khayyer2024], which has no such bound: a row of particles is lost as soon as it bends.
template <int Dim>
Sym<double, Dim> gradient_correction(const Sym<double, Dim>& M) {
  double scale = trace(M);
  for (int k = 1; k < Dim; ++k) scale *= trace(M);
  return determinant(full(M)) > least_moment<Dim> * scale ? inverse(M) : Sym<double, Dim>{};
}
inline constexpr TermInfo gradient_correction_info{
    "gradient correction", "L = (−Σ V_j r_ij ⊗ ∇W)⁻¹", "[Khayyer2024] §3.1",
    "terms/gradient_correction.hpp:gradient_correction",
    "gradient correction: a linear field is exact at a surface, and far off without correction"};

}  // namespace taut
