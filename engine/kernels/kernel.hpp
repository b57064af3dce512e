#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "engine/core/pack.hpp"
#include "engine/kernels/kernel_name.hpp"

namespace taut {

/// W(r) = α/h^Dim w(q), q = r/h; 0 for q ≥ `support`. `dw` is w′, `dw_per_q` w′/q (finite at 0).
template <KernelName Name>
struct Kernel;

/// Wendland's C2 function, [Zhang2024] §6.
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
  template <class T>
  static T dw(const T& q) {
    const T u = max(1 - 0.5 * q, T{});
    return -5 * q * u * u * u;
  }
  template <class T>
  static T dw_per_q(const T& q) {
    const T u = max(1 - 0.5 * q, T{});
    return -5 * (u * u * u);
  }
  template <class T>
  static T ddw(const T& q) {
    const T u = max(1 - 0.5 * q, T{});
    return 5 * u * u * (2 * q - 1);
  }
};

/// Cubic B-spline of Monaghan and Lattanzio (1985).
template <>
struct Kernel<KernelName::cubic_spline> {
  static constexpr std::string_view name = "cubic B-spline";
  static constexpr double support = 2;

  static constexpr double alpha(int dim) {
    return dim == 3 ? 1 / std::numbers::pi : 10 / (7 * std::numbers::pi);
  }
  /// w = ¼ (2 − q)³ − (1 − q)³, truncated powers
  template <class T>
  static T w(const T& q) {
    const T u = max(T(2 - q), T{}), v = max(T(1 - q), T{});
    return 0.25 * u * u * u - v * v * v;
  }
  template <class T>
  static T dw(const T& q) {
    const T u = max(T(2 - q), T{});
    return q < 1 ? T(q * (2.25 * q - 3)) : T(-0.75 * u * u);
  }
  template <class T>
  static T dw_per_q(const T& q) {
    const T u = max(T(2 - q), T{});
    return q < 1 ? T(2.25 * q - 3) : T(-0.75 * u * u / q);
  }
};

/// (sin(πq/2)/(πq/2))⁵, [TranDuc2023] §2.1. Departure: the paper's α is 0.7103 (2D); here the integral is 1.
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
  /// Polynomial in u = (πq/2)² for sinc, accurate to 2e-18.
  static constexpr int degree = 10;
  static constexpr std::array<double, degree + 1> coefficients = [] {
    constexpr int long_degree = 15;
    constexpr double interval = 4 * scale;
    std::array<double, long_degree + 1> c{};
    c[0] = 1;
    for (int k = 1; k <= long_degree; ++k) c[k] = -c[k - 1] * interval / (2.0 * k * (2 * k + 1));
    std::array<std::array<double, long_degree + 1>, long_degree + 1> T{};  // T_n(2x − 1)
    T[0][0] = 1, T[1][0] = -1, T[1][1] = 2;
    for (int n = 2; n <= long_degree; ++n)
      for (int k = 0; k <= n; ++k)
        T[n][k] = (k > 0 ? 4 * T[n - 1][k - 1] : 0) - 2 * T[n - 1][k] - T[n - 2][k];
    for (int n = long_degree; n > degree; --n) {
      const double share = c[n] / T[n][n];
      for (int k = 0; k <= n; ++k) c[k] -= share * T[n][k];
    }
    std::array<double, degree + 1> of_u{};
    double unit = 1;
    for (int k = 0; k <= degree; ++k, unit *= interval) of_u[k] = c[k] / unit;
    return of_u;
  }();
  template <class T>
  static T sinc(const T& u) {
    T sum{};
#pragma GCC unroll 16
    for (int k = degree; k >= 0; --k) sum = sum * u + coefficients[k];
    return max(sum, T{});
  }
  /// d sinc/du
  template <class T>
  static T slope(const T& u) {
    T sum{};
#pragma GCC unroll 16
    for (int k = degree; k >= 1; --k) sum = sum * u + k * coefficients[k];
    return sum;
  }
};

/// exp(−q²), [Zhang2020] validation case 1. Departure: the cut-off at q = 3; the paper states none.
template <>
struct Kernel<KernelName::gauss> {
  static constexpr std::string_view name = "Gauss";
  static constexpr double support = 3;

  static constexpr double alpha(int dim) { return dim == 3 ? 0.17966614821808718 : 0.3183491735929349; }

  template <class T>
  static T w(const T& q) {
    return q < support ? exponential(T(-q * q)) : T{};
  }
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

template <class F>
auto with_kernel(KernelName name, const F& f) {
  switch (name) {
    case KernelName::cubic_spline:
      return f(Kernel<KernelName::cubic_spline>{});
    case KernelName::sinc:
      return f(Kernel<KernelName::sinc>{});
    case KernelName::gauss:
      return f(Kernel<KernelName::gauss>{});
    default:
      return f(Kernel<KernelName::wendland_c2>{});
  }
}

}  // namespace taut
