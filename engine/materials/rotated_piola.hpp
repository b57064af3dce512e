#pragma once

#include <limits>

#include "engine/materials/law.hpp"

namespace taut::inline TAUT_ISA {

/// The rotation nearest to F: that of its polar decomposition F = R U where det F > 0. In the plane it is
/// known in closed form, R ∝ F + cof F. Differs from [TranDuc2023] §2.3, which iterates towards the same R.
inline Mat<double, 2> nearest_rotation(const Mat<double, 2>& F) {
  const double c = F(0, 0) + F(1, 1), s = F(1, 0) - F(0, 1);
  const double length = std::sqrt(c * c + s * s);  // the sum of the principal stretches
  if (!(length > std::numeric_limits<double>::min())) return {{{1, 0}, {0, 1}}};  // a reflection has none
  return {{{c / length, -s / length}, {s / length, c / length}}};
}

/// The stress of `icb`: Hooke's law between the second Piola–Kirchhoff stress and the Green–Lagrange strain,
///   σ⁰ = 2G dev E + K tr E I,  turned by the rotation R of F:  P = R σ⁰.             [TranDuc2023] §2.3
/// With F in the place of R it would be St Venant–Kirchhoff's. The difference is of the order of the strain;
/// no energy has this P for its derivative (∂t_1/∂λ_2 = (K − 2G/3) λ_2 but ∂t_2/∂λ_1 = (K − 2G/3) λ_1 of the
/// principal stresses), so that `energy`, ½ σ⁰:E, is a diagnostic.
struct RotatedPiola {
  double K, G;  // Pa

  template <int Dim>
  Mat<double, Dim> piola(const Mat<double, Dim>& F, double) const {
    return product(nearest_rotation(F), hooke(green_strain(F), K, G));
  }
  template <int Dim>
  double energy(const Mat<double, Dim>& F, double) const {
    return hooke_energy(green_strain(F), K, G);
  }
  template <int Dim>
  Cauchy<Dim> cauchy(const Mat<double, Dim>& F, double J) const {
    return {push_forward(piola(F, J), F, J), (K - 2.0 / 3 * G) * trace(green_strain(F)) / J};
  }
};
template <>
struct LawOf<Law::rotated_piola> : RotatedPiola {
  static constexpr LawRow row{
      .law = Law::rotated_piola,
      .choice = "",
      .material_law = "neo_hookean",
      .term = {"stress", "P = R (2G dev E + K tr E I), F = R U, E = ½ (FᵀF − I)", "[TranDuc2023] §2.3",
               "materials/rotated_piola.hpp:piola", "laws: no stress at rest, Hooke's law for small strains"},
  };
};

}  // namespace taut::inline TAUT_ISA
