#pragma once

#include "engine/core/cube_root.hpp"
#include "engine/materials/law.hpp"
#include "engine/materials/stiffness.hpp"

namespace taut {

/// Nearly incompressible neo-Hookean law, [Lee2016] Eq. 8–12 with ξ = 0 and 2ζ = G. Departure: where J is an unknown,
/// the paper has J instead of j = det F (`J_in_shear`), but then collisions diverge.
struct NeoHookean {
  double K, G;  // Pa
  bool J_in_shear = false;

  template <class T, int Dim>
  static T square(const Mat<T, Dim>& F) {
    return contraction(F, F) + (3 - Dim);
  }
  /// As MooneyRivlin::Slopes.
  template <class T>
  struct Slopes {
    T F, H, j;
  };
  template <class T, int Dim>
  Slopes<T> slopes(const Mat<T, Dim>& F, const Mat<T, Dim>&, const T& j) const {
    const T root = inverse_cube_root(j), shear = G * root * root;
    const T inv_j = root * root * root;
    return {shear, T{}, -(shear * square(F) * inv_j / 3)};
  }
  template <int Dim>
  double shear_energy(const Mat<double, Dim>& F, const Mat<double, Dim>&, double j) const {
    const double root = inverse_cube_root(j);
    return 0.5 * G * (root * root * square(F) - 3);
  }
  template <class T, int Dim>
  Mat<T, Dim> piola(const Mat<T, Dim>& F, const Mat<T, Dim>& H, const T& J) const {
    const Slopes<T> by = slopes(F, H, shear_ratio(*this, F, J));
    return combination(by.F, F, K * (J - 1) + by.j, H);
  }
  template <class T, int Dim>
  Mat<T, Dim> piola(const Mat<T, Dim>& F, const T& J) const {
    return piola(F, cofactor(F), J);
  }
  template <int Dim>
  double energy(const Mat<double, Dim>& F, double J) const {
    return shear_energy(F, F, shear_ratio(*this, F, J)) + 0.5 * K * (J - 1) * (J - 1);
  }
  template <int Dim>
  Cauchy<Dim> cauchy(const Mat<double, Dim>& F, double J) const {
    const double det = determinant(F), j = shear_ratio(*this, F, J);
    const double root = inverse_cube_root(j), shear = G * root * root / j;
    return {push_forward(piola(F, J), F, det),
            beside_plane<Dim>(K * (J - 1) + shear * (j / det - square(F) / 3))};
  }
  template <class T, int Dim>
  T stiffness_bound(const Mat<T, Dim>& F, const T&) const {
    const PrincipalStretches<T> l = principal_stretches(F);
    const T j = l[0] * l[1] * l[2], root = inverse_cube_root(j), shear = G * root * root;
    const T of_volume = 5.0 / 9 * shear * square(F) + K * j * j;
    return greatest_stiffness<Dim>(
        [&](int k) -> T { return of_volume / (l[k] * l[k]) - shear / 3; }, [&](int, int) { return shear; },
        [&](int k, int m) -> T {
          return (of_volume - 2.0 / 3 * shear * (l[k] * l[k] + l[m] * l[m])) / (l[k] * l[m]);
        });
  }
};
template <>
struct LawOf<Law::neo_hookean> : NeoHookean {
  static constexpr LawRow row{
      .law = Law::neo_hookean,
      .choice = "neo-hookean",
      .material_law = "neo_hookean",
      .term = {"stress", "P = G j^(−2/3) F + (K (J − 1) − G/3 j^(−5/3) F:F) H, H = cof F, j = det F",
               "[Lee2016] Eq. 8–12", "materials/neo_hookean.hpp:piola",
               "laws: the stress is zero at rest and Hooke's for small strains"},
  };
};

}  // namespace taut
