#pragma once

#include <numbers>
#include <string_view>

#include "engine/core/pack.hpp"
#include "engine/kernels/kernel_name.hpp"

namespace taut::inline TAUT_ISA {

/// W(r) = α/h^Dim w(q), ∂W/∂r = α/h^(Dim+1) w′(q), q = r/h; both are 0 from q = `support` on.
/// A kernel is one specialisation and one enumerator; the tests run over `all_kernels`.
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
};

}  // namespace taut::inline TAUT_ISA
