#pragma once

#include <cmath>

#include "engine/core/tensor.hpp"

namespace taut {

/// A = Σ_k value_k axis_k ⊗ axis_k; the axes are orthonormal, the values unsorted.
struct Principal {
  double value[3];
  Vec<double, 3> axis[3];
};

inline Principal principal_axes(const Sym<double, 3>& symmetric) {
  Mat<double, 3> A = full(symmetric), Q{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int most = 12;  // sweeps of Jacobi's method
  const double scale = std::abs(A(0, 0)) + std::abs(A(1, 1)) + std::abs(A(2, 2)) + std::abs(A(0, 1)) +
                       std::abs(A(0, 2)) + std::abs(A(1, 2));
  for (int sweep = 0; sweep < most; ++sweep) {
    if (!(std::abs(A(0, 1)) + std::abs(A(0, 2)) + std::abs(A(1, 2)) > 1e-16 * scale)) break;
    for (int a = 0; a < 2; ++a) {
      for (int b = a + 1; b < 3; ++b) {
        if (A(a, b) == 0) continue;
        const double ratio = 0.5 * (A(b, b) - A(a, a)) / A(a, b);
        const double t = (ratio >= 0 ? 1 : -1) / (std::abs(ratio) + std::sqrt(ratio * ratio + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const double ka = A(k, a), kb = A(k, b);
          A(k, a) = c * ka - s * kb, A(k, b) = s * ka + c * kb;
        }
        for (int k = 0; k < 3; ++k) {
          const double ak = A(a, k), bk = A(b, k);
          A(a, k) = c * ak - s * bk, A(b, k) = s * ak + c * bk;
          const double qa = Q(k, a), qb = Q(k, b);
          Q(k, a) = c * qa - s * qb, Q(k, b) = s * qa + c * qb;
        }
      }
    }
  }
  Principal principal;
  for (int k = 0; k < 3; ++k) {
    principal.value[k] = A(k, k);
    principal.axis[k] = {Q(0, k), Q(1, k), Q(2, k)};
  }
  return principal;
}

}  // namespace taut
