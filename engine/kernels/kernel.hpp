#pragma once

#include <cmath>
#include <numbers>
#include <string_view>

#include "engine/core/pack.hpp"
#include "engine/methods/formulation.hpp"

namespace taut::inline TAUT_ISA {

/// W(r) = α/h^Dim w(q), ∂W/∂r = α/h^(Dim+1) w′(q), q = r/h; both are 0 from q = `support` on. With w′/q,
/// which is finite, ∇_i W = α/h^(Dim+2) w′/q (x_i − x_j) takes no quotient and no unit vector. A kernel is
/// one specialisation and one enumerator; the tests run over `all_kernels`.
template <KernelName Name>
struct Kernel;

/// Wendland's C2 function, "5th-order Wendland" of [Zhang2024] §6.
template <>
struct Kernel<KernelName::wendland_c2> {
  static constexpr std::string_view name = "Wendland C2";
  static constexpr double support = 2;

  static constexpr double alpha(int dim) {
    return dim == 3 ? 21 / (16 * std::numbers::pi) : 7 / (4 * std::numbers::pi);
  }
  /// w = (1 − q/2)⁴ (1 + 2q)
  template <class T>
  static T w(const T& q) {
    const T u = max(1 - 0.5 * q, T{});
    const T u2 = u * u;
    return u2 * u2 * (1 + 2 * q);
  }
  /// w′ = −5 q (1 − q/2)³
  template <class T>
  static T dw(const T& q) {
    const T u = max(1 - 0.5 * q, T{});
    return -5 * q * u * u * u;
  }
  /// w′/q
  template <class T>
  static T dw_per_q(const T& q) {
    const T u = max(1 - 0.5 * q, T{});
    return -5 * (u * u * u);
  }
  /// w″ = 5 (1 − q/2)² (2q − 1)
  template <class T>
  static T ddw(const T& q) {
    const T u = max(1 - 0.5 * q, T{});
    return 5 * u * u * (2 * q - 1);
  }
};

/// (sin(πq/2)/(πq/2))⁵, [TranDuc2023] §2.1.
/// Differs from the paper: α there is 0.7103 (in 2D, over h²); with the digits below the integral is 1.
template <>
struct Kernel<KernelName::sinc> {
  static constexpr std::string_view name = "sinc";
  static constexpr double support = 2;

  static constexpr double alpha(int dim) { return dim == 3 ? 0.617012654222634393 : 0.710379463738679282; }

  template <class T>
  static T w(const T& q) {
    const T s = sinc(T(scale * q * q));
    return q < support ? power<5>(s) : T{};
  }
  /// w′ = 5 sinc⁴ dsinc/dq
  template <class T>
  static T dw(const T& q) {
    const T u = scale * q * q;
    return q < support ? T(10 * scale * q * power<4>(sinc(u)) * slope(u)) : T{};
  }
  template <class T>
  static T dw_per_q(const T& q) {
    const T u = scale * q * q;
    return q < support ? T(10 * scale * power<4>(sinc(u)) * slope(u)) : T{};
  }

 private:
  static constexpr double scale = std::numbers::pi * std::numbers::pi / 4;
  /// Terms of the series Σ (−u)ᵏ/(2k+1)!, u = (πq/2)² ≤ π²; what is left out is below 1e-17. A series, since
  /// the compiler's vectors have no sine and that of a library need not be the same everywhere.
  static constexpr int terms = 15;
  static constexpr double coefficient(int k) {
    double c = 1;
    for (int n = 1; n <= k; ++n) c /= -(2.0 * n) * (2.0 * n + 1);
    return c;
  }
  template <class T>
  static T sinc(const T& u) {
    T sum{};
    for (int k = terms; k >= 0; --k) sum = sum * u + coefficient(k);
    return max(sum, T{});
  }
  /// d sinc/du
  template <class T>
  static T slope(const T& u) {
    T sum{};
    for (int k = terms; k >= 1; --k) sum = sum * u + k * coefficient(k);
    return sum;
  }
};

/// exp(−q²), [Zhang2020] validation case 1. Slow: for pairs that never change.
/// Differs from the paper, which does not say where it ends: cut off at 3 h, where it is 1e-4, with the α
/// that makes its integral 1.
template <>
struct Kernel<KernelName::gauss> {
  static constexpr std::string_view name = "Gauss";
  static constexpr double support = 3;

  static constexpr double alpha(int dim) { return dim == 3 ? 0.17966614821808718 : 0.3183491735929349; }

  template <class T>
  static T w(const T& q) {
    return q < support ? exponential(T(-q * q)) : T{};
  }
  /// w′ = −2 q exp(−q²)
  template <class T>
  static T dw(const T& q) {
    return -2 * q * w(q);
  }
  template <class T>
  static T dw_per_q(const T& q) {
    return -2 * w(q);
  }

 private:
  static double exponential(double a) { return std::exp(a); }
  static Pack exponential(const Pack& a) {
    return Pack{std::exp(a[0]), std::exp(a[1]), std::exp(a[2]), std::exp(a[3])};
  }
};

}  // namespace taut::inline TAUT_ISA
