#pragma once

#include <cmath>

#include "engine/core/tensor.hpp"
#include "engine/materials/law_row.hpp"

/// Elastic laws of F, in 2D in plane strain (F_zz = 1): structs of K, G (Pa) and parameters with
///   piola(F, J)           N per initial m²
///   energy(F, J)          J per initial m³, 0 at rest
///   cauchy(F, J)          Pa
///   stiffness_bound(F, J) upper bound of ρ0 c² of all waves, Pa; c in initial lengths per time (THEORY.md)
/// J is det F or an unknown ([Lee2016] Eq. 33c). A law that takes_volume_ratio also has
///   piola(F, H, J)        H is cof F or an unknown ([Lee2016] Eq. 12)
///   shear_energy(F, H, j) j: volume ratio
///   slopes(F, H, j)       derivatives of shear_energy by F, H and j, Pa; the first two divided by F and H
namespace taut {

/// In Pa; `zz`, normal to the plane, is 0 in 3D.
template <int Dim>
struct Cauchy {
  Sym<double, Dim> sigma;
  double zz;
};
template <int Dim>
double beside_plane(double zz) {
  return Dim == 2 ? zz : 0;
}

/// Derives from the law's struct; has a static LawRow `row`.
template <Law law>
struct LawOf;

/// A : B
template <class T, int Dim>
T contraction(const Mat<T, Dim>& A, const Mat<T, Dim>& B) {
  T s{};
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) s += A(a, b) * B(a, b);
  return s;
}

/// Volume ratio j in the shear energy.
template <class Law, class T, int Dim>
T shear_ratio(const Law& law, const Mat<T, Dim>& F, const T& J) {
  return law.J_in_shear ? J : determinant(F);
}

template <class S, class R, class T, int Dim>
Mat<T, Dim> combination(const S& s, const Mat<T, Dim>& A, const R& t, const Mat<T, Dim>& B) {
  Mat<T, Dim> C;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) C(a, b) = s * A(a, b) + t * B(a, b);
  return C;
}

/// H ⨯ F; in plane strain F_zz = 1, H_zz = det F.
template <class T>
Mat<T, 3> stress_of_cofactor(const Mat<T, 3>& F, const Mat<T, 3>& H) {
  return tensor_cross(H, F);
}
template <class T>
Mat<T, 2> stress_of_cofactor(const Mat<T, 2>& F, const Mat<T, 2>& H) {
  return combination(1.0, cofactor(H), determinant(F), cofactor(F));
}

template <class T, int Dim>
Sym<T, Dim> green_strain(const Mat<T, Dim>& F) {
  Sym<T, Dim> E;
  for (int a = 0; a < Dim; ++a) {
    for (int b = a; b < Dim; ++b) {
      T c{};
      for (int k = 0; k < Dim; ++k) c += F(k, a) * F(k, b);
      E(a, b) = 0.5 * (c - (a == b ? 1 : 0));
    }
  }
  return E;
}

/// In Pa; plane strain in 2D.
template <class T, int Dim>
Sym<T, Dim> hooke(const Sym<T, Dim>& strain, double K, double G) {
  Sym<T, Dim> stress = filled<T>(2 * G) * strain;
  const T volumetric = (K - 2.0 / 3 * G) * trace(strain);
  for (int k = 0; k < Dim; ++k) stress(k, k) += volumetric;
  return stress;
}
/// ½ ε : hooke(ε), J/m³
template <int Dim>
double hooke_energy(const Sym<double, Dim>& strain, double K, double G) {
  double squares = 0;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) squares += strain(a, b) * strain(a, b);
  return G * squares + (0.5 * K - G / 3) * trace(strain) * trace(strain);
}

/// σ = P Fᵀ/J
template <int Dim>
Sym<double, Dim> push_forward(const Mat<double, Dim>& P, const Mat<double, Dim>& F, double J) {
  Sym<double, Dim> sigma{};
  for (int a = 0; a < Dim; ++a)
    for (int b = a; b < Dim; ++b)
      for (int k = 0; k < Dim; ++k) sigma(a, b) += P(a, k) * F(b, k) / J;
  return sigma;
}

}  // namespace taut
