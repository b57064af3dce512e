#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/cube_root.hpp"
#include "engine/core/pack.hpp"
#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

/// Terms of `oenog`, derived in methods/bonded/THEORY.md.
namespace taut {

/// Modulus of bonds, at most G, in Pa. With G, a body of negative Poisson's ratio would soften in tension.
template <int Dim>
double bond_modulus(double K, double G) {
  return std::min(G, Dim == 2 ? K + G / 3 : 1.5 * K);
}

/// φ(s), s = λ²
template <class T>
T bond_energy(const T& s) {
  return (1.0 / 24) * (s * (2 * s - 3) + 1 / s);
}
inline constexpr TermInfo bond_energy_info{
    "energy", "E = Σ_i [ V_i W(F_i) + G V0_i Σ_j w_ij (φ(s_ij) − φ_c(s°_ij)) ]", "ours",
    "terms/bond.hpp:bond_energy", "bond: a linear displacement has the neo-Hookean energy and stress"};

/// 3 φ′(λ)/λ from s and 1/(2s)
template <class T>
T three_bond_slopes(const T& s, const T& half_inverse) {
  return s - 0.75 - half_inverse * half_inverse;
}
/// φ′(λ)/λ. Its product with k_ij (x_j − x_i) is the force on i, N.
template <class T>
T bond_slope(const T& s) {
  return (1.0 / 3) * three_bond_slopes(s, T(0.5 / s));
}
inline constexpr TermInfo bond_force_info{
    "bond force", "f_i = Σ_j k_ij φ′(λ_ij)/λ_ij (x_j − x_i), φ = (2λ⁴ − 3λ² + λ⁻²)/24",
    "ours, from [Zhang2024] Eq. 20", "terms/bond.hpp:bond_slope",
    "bond: slopes are the derivatives of the energies and increase"};

/// φ″(λ) is bond_stiffness plus this offset.
inline constexpr double bond_stiffness_offset = -0.25;
template <class T>
T bond_stiffness(const T& s, const T& half_inverse) {
  return s + half_inverse * half_inverse;
}

/// Range of s with φ_c = φ.
template <int Dim>
inline constexpr std::array<double, 2> cancelled_range = {0.25, Dim == 2 ? 6.25 : 4};
template <int Dim, class T>
T limited_stretch(const T& s) {
  constexpr auto range = cancelled_range<Dim>;
  return min(max(s, filled<T>(range[0])), filled<T>(range[1]));
}
template <int Dim, class T>
T cancelled_energy(const T& s) {
  const T inside = limited_stretch<Dim>(s);
  return bond_energy(inside) + 0.5 * bond_slope(inside) * (s - inside);
}
template <int Dim, class T>
T cancelled_slope(const T& s) {
  return bond_slope(limited_stretch<Dim>(s));
}
template <int Dim>
double cancelled_slope_rate(double s) {
  return s == limited_stretch<Dim>(s) ? (1 + 0.5 / (s * s * s)) / 3 : 0;
}
/// Returns 3 third_of_s cancelled_slope(s), and the same for t, with one division.
template <int Dim, class T>
[[gnu::always_inline]] inline std::array<T, 2> cancelled_pulls(const T& s, const T& t, const T& third_of_s,
                                                               const T& third_of_t) {
  const T a = limited_stretch<Dim>(s), b = limited_stretch<Dim>(t), half_inverse = 0.5 / (a * b);
  return {third_of_s * three_bond_slopes(a, T(half_inverse * b)),
          third_of_t * three_bond_slopes(b, T(half_inverse * a))};
}
inline constexpr TermInfo cancelled_info{"cancelled",
                                         "T_i = V_i ∂W/∂F − G V0_i F_i Σ_j w_ij φ′(λ°)/λ° e ⊗ e, s° = e·C e, "
                                         "linear in s° outside [¼, 6¼], 3D [¼, 4]",
                                         "ours", "terms/bond.hpp:cancelled_slope",
                                         "bond: a linear displacement has the neo-Hookean energy and stress"};

/// Stiffness with the closing part of W, relative to rest.
template <class T>
T closing_stiffness(const T& J) {
  return 1 + 24 * max(1 - 2 * J, T{});
}

/// Neo-Hookean W, continued below J = ½.
template <class T>
struct ClosedNeoHookean {
  T K, G;  // Pa

  template <int Dim>
  T energy(const Mat<T, Dim>& F) const {  // Pa
    const T t = half_trace(F), J = determinant(F), cube_root = root(J);
    return 0.5 * G * (cube_root * cube_root * (2 * t + (3 - Dim)) - 3) + 0.5 * K * (J - 1) * (J - 1) +
           wave_modulus() * power<3>(closure(J));
  }
  /// ∂energy/∂F, Pa; `cube_root` = root(det F).
  template <int Dim>
  Mat<T, Dim> piola(const Mat<T, Dim>& F, const T& cube_root) const {
    const T t = half_trace(F), J = determinant(F), shear = G * cube_root * cube_root;
    const T of_c = (-1.0 / 3) * shear * power<3>(cube_root) * (2 * t + (3 - Dim));
    const T of_J =
        K * (J - 1) - 6 * wave_modulus() * power<2>(closure(J)) + of_c * limited_volume_ratio(J).slope;
    return shear * F + of_J * cofactor(F);
  }
  template <int Dim>
  Mat<T, Dim> piola(const Mat<T, Dim>& F) const {
    return piola(F, root(determinant(F)));
  }
  /// c^(−1/3)
  static T root(const T& J) { return inverse_cube_root(limited_volume_ratio(J).c); }

 private:
  struct Closed {
    T c, slope;  // dc/dJ
  };
  /// c(J) = J for J ≥ ½; below, a smooth continuation above ¼.
  static Closed limited_volume_ratio(const T& J) {
    const T one = filled<T>(1);
    if (!any(J < 0.5)) return {J, one};
    const T below = 0.25 / (0.75 - min(J, filled<T>(0.5)));
    return {J < 0.5 ? 0.25 + 0.25 * below : J, J < 0.5 ? below * below : one};
  }
  template <int Dim>
  static T half_trace(const Mat<T, Dim>& F) {
    return 0.5 * trace(right_cauchy_green(F));
  }
  static T closure(const T& J) { return max(1 - 2 * J, T{}); }
  T wave_modulus() const { return K + 4.0 / 3 * G; }
};
inline constexpr TermInfo stress_info{"stress", "f_i = Σ_j (T_i g_ij − T_j g_ji)", "ours",
                                      "terms/bond.hpp:ClosedNeoHookean",
                                      "bond: slopes are the derivatives of the energies and increase"};

}  // namespace taut
