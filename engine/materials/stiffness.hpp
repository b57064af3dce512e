#pragma once

#include "engine/core/tensor.hpp"

namespace taut {

template <class T>
T greatest_eigenvalue(const Sym<T, 2>& A) {
  const T half = 0.5 * (A(0, 0) - A(1, 1));
  return 0.5 * (A(0, 0) + A(1, 1)) + root(T(half * half + A(0, 1) * A(0, 1)));
}

/// q + 2p cos(θ/3), q = tr A/3, p² = |A − q I|²/6, cos θ = det(A − q I)/(2p³); cos(θ/3) by Newton's method.
template <class T>
T greatest_eigenvalue(const Sym<T, 3>& A) {
  const T one = filled<T>(1), q = trace(A) / 3;
  const T x = A(0, 0) - q, y = A(1, 1) - q, z = A(2, 2) - q;
  const T xy = A(0, 1), xz = A(0, 2), yz = A(1, 2);
  const T p2 = (x * x + y * y + z * z + 2 * (xy * xy + xz * xz + yz * yz)) / 6, p = root(p2);
  const T det = x * (y * z - yz * yz) - xy * (xy * z - yz * xz) + xz * (xy * yz - y * xz);
  const T cosine = p > 0 ? min(max(T(det / (2 * p * p2)), T(-one)), one) : one;
  const T s = root(T(0.5 * (1 + cosine)));  // cos(θ/2)
  T c = 0.5 + s * (0.57735 - 0.07735 * s);
  for (int round = 0; round < 2; ++round)
    c -= (c * (4 * c * c - 3) - cosine) / max(T(12 * c * c - 3), filled<T>(1e-9));
  return q + 2 * p * c;
}

/// In 2D the last is 1, normal to the plane.
template <class T>
using PrincipalStretches = Vec<T, 3>;

template <class T>
PrincipalStretches<T> principal_stretches(const Mat<T, 2>& F) {
  const T greatest = root(greatest_eigenvalue(right_cauchy_green(F))), J = determinant(F);
  return {greatest, max(J, T(-J)) / greatest, filled<T>(1)};
}
template <class T>
PrincipalStretches<T> principal_stretches(const Mat<T, 3>& F) {
  const Sym<T, 3> C = right_cauchy_green(F);
  const T greatest = greatest_eigenvalue(C), J = determinant(F);
  // product of the other two squared stretches
  const T half = 0.5 * (trace(C) - greatest), product = J * J / greatest;
  const T second = half + root(max(T(half * half - product), T{}));
  return {root(greatest), root(second), root(T(product / second))};
}

/// Upper bound, in Pa, of m·Q m over all unit vectors m and n. Q is the acoustic tensor for coefficients `along(k)`,
/// `across(k, l)` and `coupling(k, l)` in Pa (THEORY.md). Returns NaN if a coefficient is NaN.
template <int Dim, class Along, class Across, class Coupling>
auto greatest_stiffness(const Along& along, const Across& across, const Coupling& coupling) {
  using T = decltype(along(0));
  T greatest{};
  const auto take = [&](const T& stiffness) {
    greatest = ((stiffness <= greatest) | (greatest != greatest)) ? greatest : stiffness;
  };
  for (int k = 0; k < Dim; ++k) {
    take(along(k));
    for (int l = 0; l < k; ++l)
      take(greatest_eigenvalue(Sym<T, 2>{across(k, l), coupling(k, l), across(l, k)}));
  }
  return greatest;
}

}  // namespace taut
