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

}  // namespace taut::inline TAUT_ISA
