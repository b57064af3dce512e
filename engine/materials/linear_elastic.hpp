#pragma once

#include "engine/materials/law.hpp"

namespace taut {

/// For small strains and rotations only. The G of [Zhang2020] Eq. 3, 4 is twice the shear modulus.
struct LinearElastic {
  double K, G;  // Pa

  template <class T, int Dim>
  static Sym<T, Dim> strain(const Mat<T, Dim>& F) {
    Sym<T, Dim> e;
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b) e(a, b) = 0.5 * (F(a, b) + F(b, a)) - (a == b ? 1 : 0);
    return e;
  }
  template <class T, int Dim>
  Mat<T, Dim> piola(const Mat<T, Dim>& F, const T&) const {
    return full(hooke(strain(F), K, G));
  }
  template <int Dim>
  double energy(const Mat<double, Dim>& F, double) const {
    return hooke_energy(strain(F), K, G);
  }
  template <int Dim>
  Cauchy<Dim> cauchy(const Mat<double, Dim>& F, double) const {
    return {hooke(strain(F), K, G), beside_plane<Dim>((K - 2.0 / 3 * G) * trace(strain(F)))};
  }
  template <class T, int Dim>
  T stiffness_bound(const Mat<T, Dim>&, const T&) const {
    return filled<T>(K + 4.0 / 3 * G);
  }
};
template <>
struct LawOf<Law::linear_elastic> : LinearElastic {
  static constexpr LawRow row{
      .law = Law::linear_elastic,
      .choice = "linear",
      .material_law = "linear_elastic",
      .term = {"stress", "P = 2G dev ε + K tr ε I, ε = ½ (F + Fᵀ) − I", "[Zhang2020] Eq. 3, 4",
               "materials/linear_elastic.hpp:piola",
               "laws: the stress is zero at rest and Hooke's for small strains"},
  };
};

}  // namespace taut
