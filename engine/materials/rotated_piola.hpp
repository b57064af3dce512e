#pragma once

#include <cmath>
#include <limits>

#include "engine/materials/law.hpp"
#include "engine/materials/stiffness.hpp"

namespace taut {

/// exp(ω×) R; `angle` = |ω|.
inline Mat<double, 3> turned_by(const Vec<double, 3>& omega, double angle, const Mat<double, 3>& R) {
  const Vec<double, 3> n = (1 / angle) * omega;
  const double c = std::cos(angle), s = std::sin(angle);
  Mat<double, 3> result;
  for (int a = 0; a < 3; ++a) {
    const Vec<double, 3> column{R(0, a), R(1, a), R(2, a)};
    const double along = (1 - c) * dot(n, column);
    const Vec<double, 3> across = cross(n, column);
    for (int k = 0; k < 3; ++k) result(k, a) = c * column[k] + s * across[k] + along * n[k];
  }
  return result;
}

/// Whether RᵀF has a positive determinant and two negative eigenvalues. RᵀF must be symmetric.
inline bool is_half_turn(const Mat<double, 3>& R, const Mat<double, 3>& F) {
  Mat<double, 3> U{};
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 3; ++c) U(a, b) += R(c, a) * F(c, b);
  double minors = 0;
  for (int a = 0, b = 1; a < 3; ++a, b = (b + 1) % 3) minors += U(a, a) * U(b, b) - U(a, b) * U(b, a);
  return determinant(F) > 0 && !(trace(U) > 0 && minors > 0);
}

/// R of F = R U if det F > 0.
template <class T>
Mat<T, 2> nearest_rotation(const Mat<T, 2>& F) {
  const T c = F(0, 0) + F(1, 1), s = F(1, 0) - F(0, 1);
  const T length = root(T(c * c + s * s));
  const auto turned =
      length > std::numeric_limits<double>::min();  // false for a reflection with equal stretches
  const T cosine = turned ? T(c / length) : filled<T>(1), sine = turned ? T(s / length) : T{};
  return {{{cosine, -sine}, {sine, cosine}}};
}

/// Müller's iteration, [TranDuc2023] §2.3. Departures: the absolute value of `along`, for convergence beyond 90°; a
/// restart if the torque vanishes because two axes are turned by 180°.
inline Mat<double, 3> nearest_rotation(const Mat<double, 3>& F) {
  Mat<double, 3> R{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int most = 100;
  for (int k = 0; k < most; ++k) {
    Vec<double, 3> torque{};
    double along = 0;
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 3; ++c) {
        torque[c] += R((c + 1) % 3, a) * F((c + 2) % 3, a) - R((c + 2) % 3, a) * F((c + 1) % 3, a);
        along += R(c, a) * F(c, a);
      }
    }
    const Vec<double, 3> omega = (1 / (std::abs(along) + 1e-9)) * torque;
    const double angle = std::sqrt(dot(omega, omega));
    if (angle > 1e-15) {
      R = turned_by(omega, angle, R);
      continue;
    }
    if (!is_half_turn(R, F)) break;
    R = turned_by({1, 2, 3}, std::sqrt(14.0), R);
  }
  return R;
}

inline Mat<Pack, 3> nearest_rotation(const Mat<Pack, 3>& F) {
  Mat<Pack, 3> R;
  for (int lane = 0; lane < lanes; ++lane) set_lane(R, lane, nearest_rotation(lane_of(F, lane)));
  return R;
}

/// Stress of `icb`, [TranDuc2023] §2.3, not derived from an energy; `energy` is a diagnostic.
struct RotatedPiola {
  double K, G;  // Pa

  template <class T, int Dim>
  Mat<T, Dim> piola(const Mat<T, Dim>& F, const T&) const {
    return product(nearest_rotation(F), hooke(green_strain(F), K, G));
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
  /// Bound for the symmetric part of the acoustic tensor (THEORY.md).
  template <class T, int Dim>
  T stiffness_bound(const Mat<T, Dim>& F, const T&) const {
    const PrincipalStretches<T> l = principal_stretches(F);
    const double lambda = K - 2.0 / 3 * G;
    const T sum = lambda * trace(green_strain(F));
    const auto turning = [&](int k, int m) -> T {  // ½ (t_k + t_m)/(λ_k + λ_m)
      return (sum + 0.5 * G * (l[k] * l[k] + l[m] * l[m] - 2)) / (l[k] + l[m]);
    };
    return greatest_stiffness<Dim>(
        [&](int k) -> T { return (lambda + 2 * G) * l[k]; },
        [&](int k, int m) -> T { return 0.5 * G * (l[k] + l[m]) + turning(k, m); },
        [&](int k, int m) -> T { return 0.5 * (lambda + G) * (l[k] + l[m]) - turning(k, m); });
  }
};
template <>
struct LawOf<Law::rotated_piola> : RotatedPiola {
  static constexpr LawRow row{
      .law = Law::rotated_piola,
      .choice = "",
      .material_law = "neo_hookean",
      .term = {"stress", "P = R (2G dev E + K tr E I), F = R U, E = ½ (FᵀF − I)", "[TranDuc2023] §2.3",
               "materials/rotated_piola.hpp:piola",
               "laws: the stress is zero at rest and Hooke's for small strains"},
  };
};

}  // namespace taut
