#pragma once

#include "engine/core/cube_root.hpp"
#include "engine/core/tensor.hpp"
#include "engine/materials/law.hpp"

namespace taut::inline TAUT_ISA {

/// The stress that is shown of particles, below J = ½ that of the law without its continuation. T: of one or
/// of four.
template <class T, int Dim>
struct ShownStress {
  T J, p;         // p in Pa
  Sym<T, Dim> s;  // the deviator, Pa
  T s_zz;         // beside the plane, in 2D
};

/// p = −K (J − 1) and s = G J^(−5/3) dev(F Fᵀ) with (F Fᵀ)_zz = 1 in 2D and J no less than 0.05
template <int Dim>
ShownStress<Pack, Dim> shown_neo_hookean(const Pack& K, const Pack& G, const Mat<Pack, Dim>& F) {
  const Pack J = determinant(F), root = inverse_cube_root(max(J, filled<Pack>(0.05)));
  Sym<Pack, Dim> b{};
  for (int a = 0; a < Dim; ++a)
    for (int k = a; k < Dim; ++k)
      for (int l = 0; l < Dim; ++l) b(a, k) += F(a, l) * F(k, l);
  const Pack mean = (trace(b) + (3 - Dim)) / 3, shear = G * power<5>(root);
  for (int k = 0; k < Dim; ++k) b(k, k) -= mean;
  return {J, -K * (J - 1), shear * b, shear * (1 - mean)};
}

/// Of another law; a pressure −K (J − 1) alone where J is below 0.05.
template <class L, int Dim>
ShownStress<double, Dim> shown_stress(const L& law, const Mat<double, Dim>& F) {
  const double J = determinant(F);
  if (!(J >= 0.05)) return {J, -law.K * (J - 1), {}, 0};
  auto [sigma, zz] = law.cauchy(F, J);
  const double p = -(trace(sigma) + zz) / 3;
  for (int k = 0; k < Dim; ++k) sigma(k, k) += p;
  return {J, p, sigma, zz + p};
}

}  // namespace taut::inline TAUT_ISA
