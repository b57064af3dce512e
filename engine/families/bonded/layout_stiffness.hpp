#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/isa.hpp"
#include "engine/core/tensor.hpp"

namespace taut::inline TAUT_ISA {

/// ω² of the stiffest swing of n particles about where they are, 1/s², from below and to about a hundredth: by
/// power iteration from a start that is the same every time. accelerations(u) are those that displacements u,
/// of length `small` at the most, give, m/s².
template <int Dim, class Accelerations>
double stiffest_swing(int n, double small, const Accelerations& accelerations) {
  using Field = std::vector<Vec<double, Dim>>;
  const auto greatest = [](const Field& field) {
    double square = 0;
    for (const auto& one : field) square = std::max(square, dot(one, one));
    return std::sqrt(square);
  };
  Field u(n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < Dim; ++k) u[i][k] = std::sin(12.9898 * (Dim * i + k + 1) + 78.233);
  const Field rest = accelerations(Field(n));
  double square = 0;
  constexpr int rounds = 30;
  for (int round = 0; round < rounds; ++round) {
    const double size = greatest(u);
    if (!(size > 0)) return 0;
    for (auto& one : u) one = (small / size) * one;
    Field next = accelerations(u);
    double work = 0, length = 0;
    for (int i = 0; i < n; ++i) {
      next[i] = rest[i] - next[i];
      work += dot(next[i], next[i]), length += dot(u[i], u[i]);
    }
    square = std::sqrt(work / length);
    u.swap(next);
  }
  return square;
}

}  // namespace taut::inline TAUT_ISA
