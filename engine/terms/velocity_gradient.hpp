#pragma once

#include "engine/core/tensor.hpp"

namespace taut::inline TAUT_ISA {

/// L = ∇v = −Σ V_j v_ij ⊗ ∇_i W: adds the part of one neighbour, 1/s.             [Zhang2024] Eq. 14
/// Differs from the paper in sign: it prints v_ij = v_i − v_j without the minus.
template <class T, int Dim>
void add_velocity_gradient(Mat<T, Dim>& L, const T& V_j, const T& dW, const Vec<T, Dim>& v_ij,
                           const Vec<T, Dim>& e_ij) {
  add_outer(L, T(-V_j * dW), v_ij, e_ij);
}

/// M = −Σ V_j r_ij ⊗ ∇_i W, so that B = M⁻¹ makes the gradient L·B of a linear field exact; dimensionless.
/// [Zhang2024] Eq. 27, with the sign of Eq. 14 as above
template <class T, int Dim>
void add_gradient_moment(Sym<T, Dim>& M, const T& V_j, const T& dW, const T& r, const Vec<T, Dim>& e_ij) {
  add_outer(M, T(-V_j * dW * r), e_ij);
}

}  // namespace taut::inline TAUT_ISA
