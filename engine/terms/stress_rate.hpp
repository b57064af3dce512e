#pragma once

#include "engine/core/tensor.hpp"
#include "engine/methods/formulation.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Rate of the deviatoric stress, 2G (D − tr D/n I) + ω s − s ω, Pa/s. n = d in [Zhang2024] Eq. 7, n = 3 in
/// [Khayyer2024] Eq. 6. Departure: [Zhang2024] lacks the rotation terms; its rate is not objective.
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
template <Deviator deviator>
Sym<double, 2> jaumann_rate(const Mat<double, 2>& L, const Sym<double, 2>& s, double G) {
  constexpr double n = deviator == Deviator::in_plane ? 2 : 3;
  const double mean = (L(0, 0) + L(1, 1)) / n, spin = L(0, 1) - L(1, 0);  // 2 ω_01
  const double turned = spin * s(0, 1);
  return {2 * G * (L(0, 0) - mean) + turned, G * (L(0, 1) + L(1, 0)) + 0.5 * spin * (s(1, 1) - s(0, 0)),
          2 * G * (L(1, 1) - mean) - turned};
}
inline constexpr TermInfo jaumann_rate_info{
    "stress rate", "ds/dt = 2G (D − tr D/d I) + ω s − s ω", "[Zhang2024] Eq. 7",
    "terms/stress_rate.hpp:jaumann_rate",
    "stress rate: stretch and shear give values computed by hand, for both deviators"};

/// Stress after dt, R s Rᵀ + 2G (D − tr D/n I) dt, R = (I − ½ dt ω)⁻¹ (I + ½ dt ω). Departure: with [Khayyer2024] Eq.
/// 24, a rigid rotation enlarges s in each step.
template <Deviator deviator>
Sym<double, 2> turned_stress(const Mat<double, 2>& L, const Sym<double, 2>& s, double G, double dt) {
  const double half = 0.25 * dt * (L(0, 1) - L(1, 0)), scale = 1 / (1 + half * half);
  const double cosine = scale * (1 - half * half), sine = 2 * scale * half;  // R = [cos sin; −sin cos]
  const double mean = 0.5 * trace(s), difference = 0.5 * (s(0, 0) - s(1, 1));
  const double cos2 = cosine * cosine - sine * sine, sin2 = 2 * sine * cosine;
  const double turned = cos2 * difference + sin2 * s(0, 1);
  Sym<double, 2> result{mean + turned, cos2 * s(0, 1) - sin2 * difference, mean - turned};
  return result += dt * jaumann_rate<deviator>(L, Sym<double, 2>{}, G);
}
/// The 3D form is ours: [Khayyer2024] treats the plane. R = I + 2 (A + A²)/(1 + |a|²), A v = ½ dt ω v = a × v.
template <Deviator deviator>
Sym<double, 3> turned_stress(const Mat<double, 3>& L, const Sym<double, 3>& s, double G, double dt) {
  Mat<double, 3> A;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) A(k, l) = 0.25 * dt * (L(k, l) - L(l, k));
  const double a2 = A(0, 1) * A(0, 1) + A(0, 2) * A(0, 2) + A(1, 2) * A(1, 2);
  Mat<double, 3> R = (2 / (1 + a2)) * (A + product(A, A));
  for (int k = 0; k < 3; ++k) R(k, k) += 1;
  return symmetric_part(product_transposed(product(R, s), R)) +
         dt * jaumann_rate<deviator>(L, Sym<double, 3>{}, G);
}
inline constexpr TermInfo turned_stress_info{
    "stress rate", "ds/dt = 2G (D − tr D/3 I) + ω s − s ω", "[Khayyer2024] Eq. 6, 7",
    "terms/stress_rate.hpp:turned_stress",
    "rotated stress: a rigid rotation in one step rotates the stress and keeps its magnitude"};

}  // namespace taut
