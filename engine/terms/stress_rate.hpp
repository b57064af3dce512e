#pragma once

#include "engine/core/tensor.hpp"
#include "engine/methods/formulation.hpp"

namespace taut::inline TAUT_ISA {

/// Jaumann rate of the deviatoric stress,
///   ds/dt = 2G (D − tr D/n I) + ω s − s ω,   D = ½ (L + Lᵀ),  ω = ½ (L − Lᵀ),   Pa/s,
/// n = d [Zhang2024] Eq. 7 or 3 [Khayyer2024] Eq. 6. With L dt in place of L it gives the increment.
/// Differs from [Zhang2024], which prints no rotation terms: without them the stress is not objective.
template <Deviator deviator, int Dim>
Sym<double, Dim> jaumann_rate(const Mat<double, Dim>& L, const Sym<double, Dim>& s, double G) {
  constexpr double n = deviator == Deviator::in_plane ? Dim : 3;
  double mean = 0;
  for (int k = 0; k < Dim; ++k) mean += L(k, k) / n;
  Sym<double, Dim> rate;
  for (int a = 0; a < Dim; ++a) {
    for (int b = a; b < Dim; ++b) {
      double r = G * (L(a, b) + L(b, a)) - (a == b ? 2 * G * mean : 0);
      for (int k = 0; k < Dim; ++k)
        r += 0.5 * ((L(a, k) - L(k, a)) * s(k, b) - s(a, k) * (L(k, b) - L(b, k)));
      rate(a, b) = r;
    }
  }
  return rate;
}

}  // namespace taut::inline TAUT_ISA
