#pragma once

#include "engine/core/tensor.hpp"
#include "engine/materials/chosen_laws.hpp"
#include "engine/terms/bond.hpp"

namespace taut {

/// Continuation of any law below J = ½, as in ClosedNeoHookean. Laws without a separate shear part get only the term
/// (K + 4G/3)(1 − 2J)³.
struct Continuation {
  double J, c, per_J;  // det F; its replacement; dc/dJ
  double closure;      // 1 − 2J, or 0

  explicit Continuation(double det) : J(det), c(det), per_J(1), closure(0) {
    if (!(J < 0.5)) return;
    const double below = 0.25 / (0.75 - J);
    c = 0.25 + 0.25 * below, per_J = below * below, closure = 1 - 2 * J;
  }
};

template <class L, int Dim>
double closed_energy(const L& law, const Mat<double, Dim>& F) {
  const Continuation at(determinant(F));
  const double closing = (law.K + 4.0 / 3 * law.G) * power<3>(at.closure);
  if constexpr (requires { law.shear_energy(F, F, at.c); })
    return law.shear_energy(F, cofactor(F), at.c) + 0.5 * law.K * power<2>(at.J - 1) + closing;
  else
    return law.energy(F, at.J) + closing;
}

/// ∂closed_energy/∂F.
template <class L, int Dim>
Mat<double, Dim> closed_piola(const L& law, const Mat<double, Dim>& F) {
  const Continuation at(determinant(F));
  const Mat<double, Dim> H = cofactor(F);
  const double closing = -6 * (law.K + 4.0 / 3 * law.G) * power<2>(at.closure);
  if constexpr (requires { law.slopes(F, H, at.c); }) {
    const auto by = law.slopes(F, H, at.c);
    const double of_J = law.K * (at.J - 1) + by.j * at.per_J + closing;
    return combination(1.0, combination(by.F, F, of_J, H), by.H, stress_of_cofactor(F, H));
  } else {
    return combination(1.0, law.piola(F, at.J), closing, H);
  }
}

template <class L, int Dim>
Pack closed_energy(const L* laws, const int* material, const Mat<Pack, Dim>& F) {
  Pack energy{};
  for (int lane = 0; lane < lanes; ++lane)
    energy[lane] = closed_energy(laws[material[lane]], lane_of(F, lane));
  return energy;
}
template <class L, int Dim>
Mat<Pack, Dim> closed_piola(const L* laws, const int* material, const Mat<Pack, Dim>& F) {
  Mat<Pack, Dim> P;
  for (int lane = 0; lane < lanes; ++lane) {
    const Mat<double, Dim> own = closed_piola(laws[material[lane]], lane_of(F, lane));
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < Dim; ++k) P(a, k)[lane] = own(a, k);
  }
  return P;
}

}  // namespace taut
