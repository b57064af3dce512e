#pragma once

#include <cmath>
#include <numbers>

#include "engine/core/cube_root.hpp"
#include "engine/materials/law.hpp"
#include "engine/materials/stiffness.hpp"

namespace taut {

/// Nearly incompressible Mooney–Rivlin law, [Lee2016] Eq. 8–12, with G = 2ζ + 3√3 ξ. A `cofactor_share` of 0 is
/// neo-Hookean, 1 is [Lee2016] §8.7. Departure: see NeoHookean.
struct MooneyRivlin {
  double K, G;            // Pa
  double cofactor_share;  // 3√3 ξ/G
  bool J_in_shear = false;

  /// Σ_F/F, Σ_H/H and Σ_j, Pa.
  template <class T>
  struct Slopes {
    T F, H, j;
  };
  template <class T, int Dim>
  Slopes<T> slopes(const Mat<T, Dim>& F, const Mat<T, Dim>& H, const T& j) const {
    const T cube_root = inverse_cube_root(j), inv_j = cube_root * cube_root * cube_root;
    const T of_F = 2 * zeta() * cube_root * cube_root,
            of_H = 3 * xi() * inv_j * inv_j * root(square_of_H(F, H));
    return {of_F, of_H, (-1.0 / 3 * of_F * square(F) - 2.0 / 3 * of_H * square_of_H(F, H)) * inv_j};
  }
  template <int Dim>
  double shear_energy(const Mat<double, Dim>& F, const Mat<double, Dim>& H, double j) const {
    const double root = inverse_cube_root(j), inv_j = root * root * root, HH = square_of_H(F, H);
    return zeta() * (root * root * square(F) - 3) +
           xi() * (inv_j * inv_j * HH * std::sqrt(HH) - 3 * std::numbers::sqrt3);
  }

  template <class T, int Dim>
  Mat<T, Dim> piola(const Mat<T, Dim>& F, const Mat<T, Dim>& H, const T& J) const {
    const Slopes<T> by = slopes(F, H, shear_ratio(*this, F, J));
    return combination(1.0, combination(by.F, F, by.j + K * (J - 1), H), by.H, stress_of_cofactor(F, H));
  }
  template <class T, int Dim>
  Mat<T, Dim> piola(const Mat<T, Dim>& F, const T& J) const {
    return piola(F, cofactor(F), J);
  }
  template <int Dim>
  double energy(const Mat<double, Dim>& F, double J) const {
    return shear_energy(F, cofactor(F), shear_ratio(*this, F, J)) + 0.5 * K * (J - 1) * (J - 1);
  }
  template <int Dim>
  Cauchy<Dim> cauchy(const Mat<double, Dim>& F, double J) const {
    const double j = determinant(F);
    const Slopes by = slopes(F, cofactor(F), shear_ratio(*this, F, J));
    const double zz = (by.F + by.H * contraction(F, F)) / j + by.j + K * (J - 1);
    return {push_forward(piola(F, J), F, j), beside_plane<Dim>(zz)};
  }
  template <class T, int Dim>
  T stiffness_bound(const Mat<T, Dim>& F, const T&) const {
    const PrincipalStretches<T> l = principal_stretches(F);
    const T j = l[0] * l[1] * l[2], cube_root = inverse_cube_root(j), FF = square(F);
    const Vec<T, 3> H{l[1] * l[2], l[0] * l[2], l[0] * l[1]};
    const T HH = dot(H, H), size = root(HH);
    const T of_F = 2 * zeta() * cube_root * cube_root, of_H = 3 * xi() * size / (j * j);
    const T of_volume = 5.0 / 9 * of_F * FF + K * j * j;
    Vec<T, 3> w, g;
    for (int k = 0; k < 3; ++k) {
      w[k] = H[k] * H[k] * H[k] / (j * size);
      g[k] = l[k] * (FF - l[k] * l[k]) / size;
    }
    return greatest_stiffness<Dim>(
        [&](int k) -> T {
          return of_volume / (l[k] * l[k]) - of_F / 3 +
                 of_H * (FF - l[k] * l[k] + 2 * w[k] * w[k] - g[k] * g[k]);
        },
        [&](int k, int m) -> T { return of_F + of_H * (FF - l[k] * l[k] - l[m] * l[m]); },
        [&](int k, int m) -> T {
          return (of_volume - 2.0 / 3 * of_F * (l[k] * l[k] + l[m] * l[m])) / (l[k] * l[m]) +
                 of_H * (l[k] * l[m] + 2 * w[k] * w[m] - g[k] * g[m]);
        });
  }

 private:
  double zeta() const { return 0.5 * (1 - cofactor_share) * G; }
  double xi() const { return cofactor_share * G / (3 * std::numbers::sqrt3); }
  template <class T, int Dim>
  static T square(const Mat<T, Dim>& F) {  // F:F
    return contraction(F, F) + (3 - Dim);
  }
  template <class T, int Dim>
  static T square_of_H(const Mat<T, Dim>& F, const Mat<T, Dim>& H) {  // H:H
    const T zz = Dim == 2 ? determinant(F) : T{};
    return contraction(H, H) + zz * zz;
  }
};
template <>
struct LawOf<Law::mooney_rivlin> : MooneyRivlin {
  static constexpr LawParameter share[] = {
      {"cofactor_share", 1.0, 0.0, 1.0,
       "share of the shear modulus in the cofactor term, 3√3 ξ/G; 0 is neo-Hookean"}};
  static constexpr LawRow row{
      .law = Law::mooney_rivlin,
      .choice = "mooney-rivlin",
      .material_law = "mooney_rivlin",
      .term = {"stress",
               "P = 2ζ j^(−2/3) F + 3ξ j^(−2) |H| H ⨯ F + (K (J − 1) + Σ_j) H, H = cof F, j = det F",
               "[Lee2016] Eq. 8–12", "materials/mooney_rivlin.hpp:piola",
               "laws: the stress is zero at rest and Hooke's for small strains"},
      .parameters = share,
  };
};

}  // namespace taut
