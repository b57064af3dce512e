#pragma once

#include "engine/materials/law.hpp"
#include "engine/materials/stiffness.hpp"

namespace taut {

/// St Venant–Kirchhoff law. Softens in compression.
struct StVenantKirchhoff {
  double K, G;  // Pa

  template <class T, int Dim>
  Mat<T, Dim> piola(const Mat<T, Dim>& F, const T&) const {
    return product(F, hooke(green_strain(F), K, G));
  }
  template <int Dim>
  double energy(const Mat<double, Dim>& F, double) const {
    return hooke_energy(green_strain(F), K, G);
  }
  template <int Dim>
  Cauchy<Dim> cauchy(const Mat<double, Dim>& F, double J) const {
    return {push_forward(piola(F, J), F, J),
            beside_plane<Dim>((K - 2.0 / 3 * G) * trace(green_strain(F)) / J)};
  }
  template <class T, int Dim>
  T stiffness_bound(const Mat<T, Dim>& F, const T&) const {
    const PrincipalStretches<T> l = principal_stretches(F);
    const T sum = (K - 2.0 / 3 * G) * trace(green_strain(F));
    const auto S = [&](int k) -> T { return sum + G * (l[k] * l[k] - 1); };
    return greatest_stiffness<Dim>([&](int k) -> T { return S(k) + (K + 4.0 / 3 * G) * l[k] * l[k]; },
                                   [&](int k, int m) -> T { return S(m) + G * l[k] * l[k]; },
                                   [&](int k, int m) -> T { return (K + G / 3) * l[k] * l[m]; });
  }
};
template <>
struct LawOf<Law::st_venant_kirchhoff> : StVenantKirchhoff {
  static constexpr LawRow row{
      .law = Law::st_venant_kirchhoff,
      .choice = "st-venant-kirchhoff",
      .material_law = "st_venant_kirchhoff",
      .term = {"stress", "P = F (2G dev E + K tr E I), E = ½ (FᵀF − I)", "textbook",
               "materials/st_venant_kirchhoff.hpp:piola",
               "laws: the stress is zero at rest and Hooke's for small strains"},
  };
};

}  // namespace taut
