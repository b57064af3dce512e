#pragma once

#include "engine/materials/law.hpp"

namespace taut::inline TAUT_ISA {

/// St Venant–Kirchhoff: Hooke's law between the second Piola–Kirchhoff stress S and the Green–Lagrange strain
/// E, P = F S. Softens without end in compression: for large rotations with moderate strains.
struct StVenantKirchhoff {
  double K, G;  // Pa

  template <int Dim>
  Mat<double, Dim> piola(const Mat<double, Dim>& F, double) const {
    return product(F, hooke(green_strain(F), K, G));
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
struct LawOf<Law::st_venant_kirchhoff> : StVenantKirchhoff {};

}  // namespace taut::inline TAUT_ISA
