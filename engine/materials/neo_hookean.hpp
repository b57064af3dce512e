#pragma once

#include "engine/core/cube_root.hpp"
#include "engine/materials/law.hpp"

namespace taut::inline TAUT_ISA {

/// Nearly incompressible neo-Hookean, [Lee2016] Eq. 8–12 with ξ = 0 and 2ζ = G:
///   ψ = G/2 (j^(−2/3) F:F − 3) + K/2 (J − 1)²,   j = det F,
///   P = G j^(−2/3) F + (K (J − 1) − G/3 j^(−5/3) F:F) H,   H = cof F.
/// In plane strain F:F holds F_zz² = 1.
/// Differs from the paper where J is followed by an equation of its own: there it stands for j too. Where the
/// dissipation of J parts it from det F, that makes the deviator push along: at J = 1, F = λ I it answers a
/// change of volume with a stiffness of −4G/3, and rings are lost in their collision. With j it answers none.
struct NeoHookean {
  double K, G;  // Pa

  template <int Dim>
  static double square(const Mat<double, Dim>& F) {
    return contraction(F, F) + (3 - Dim);
  }
  template <int Dim>
  Mat<double, Dim> piola(const Mat<double, Dim>& F, double J) const {
    const double root = inverse_cube_root(determinant(F)), shear = G * root * root;
    const double inv_j = root * root * root;
    return combination(shear, F, K * (J - 1) - shear * square(F) * inv_j / 3, cofactor(F));
  }
  Mat<double, 3> piola(const Mat<double, 3>& F, const Mat<double, 3>& H, double J) const {  // TEMP
    const double root = inverse_cube_root(determinant(F)), shear = G * root * root;
    const double inv_j = root * root * root;
    return combination(shear, F, K * (J - 1) - shear * square(F) * inv_j / 3, H);
  }
  static double greatest_stretch(const Mat<double, 3>& A) {  // TEMP
    const Sym<double, 3> C = right_cauchy_green(A);
    const double q = trace(C) / 3;
    const double off = C(0, 1) * C(0, 1) + C(0, 2) * C(0, 2) + C(1, 2) * C(1, 2);
    const double p2 = (C(0, 0) - q) * (C(0, 0) - q) + (C(1, 1) - q) * (C(1, 1) - q) +
                      (C(2, 2) - q) * (C(2, 2) - q) + 2 * off;
    return std::sqrt(q + 2 * std::sqrt(p2 / 6));  // at most
  }
  double stiffness_bound(const Mat<double, 3>& F, double) const {  // TEMP
    const double J = determinant(F), root = inverse_cube_root(J);
    const double sF = greatest_stretch(F), sH = greatest_stretch(cofactor(F));
    return G * root * root + (10.0 / 18 * G * std::pow(J, -8.0 / 3) * square(F) + K) * sH * sH +
           2.0 / 3 * G * std::pow(J, -5.0 / 3) * (sF * sH - J);
  }
  template <int Dim>
  double energy(const Mat<double, Dim>& F, double J) const {
    const double root = inverse_cube_root(determinant(F));
    return 0.5 * G * (root * root * square(F) - 3) + 0.5 * K * (J - 1) * (J - 1);
  }
  template <int Dim>
  Cauchy<Dim> cauchy(const Mat<double, Dim>& F, double J) const {
    const double j = determinant(F), root = inverse_cube_root(j), shear = G * root * root / j;
    return {push_forward(piola(F, J), F, j), beside_plane<Dim>(K * (J - 1) + shear * (1 - square(F) / 3))};
  }
};
template <>
struct LawOf<Law::neo_hookean> : NeoHookean {
  static constexpr LawRow row{
      .law = Law::neo_hookean,
      .choice = "neo-hookean",
      .material_law = "neo_hookean",
      .term = {"stress", "P = G j^(−2/3) F + (K (J − 1) − G/3 j^(−5/3) F:F) cof F, j = det F",
               "[Lee2016] Eq. 8–12", "materials/neo_hookean.hpp:piola",
               "laws: no stress at rest, Hooke's law for small strains"},
  };
};

}  // namespace taut::inline TAUT_ISA
