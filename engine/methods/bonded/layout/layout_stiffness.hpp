#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/core/tensor.hpp"

namespace taut {

/// Maximum eigenvalue of a symmetric tridiagonal matrix with the off-diagonal `beside`, by bisection. NaN for NaN.
inline double greatest_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  const std::size_t n = diagonal.size();
  const auto is_above = [&](double lambda) {
    double pivot = diagonal[0] - lambda;
    for (std::size_t k = 1; k < n && pivot < 0; ++k)
      pivot = diagonal[k] - lambda - beside[k - 1] * beside[k - 1] / pivot;
    return pivot < 0;
  };
  double low = diagonal[0], high = low;
  for (std::size_t k = 0; k < n; ++k) {  // Gershgorin disc
    const double radius = (k > 0 ? std::abs(beside[k - 1]) : 0) + (k + 1 < n ? std::abs(beside[k]) : 0);
    low = greater(low, diagonal[k]), high = greater(high, diagonal[k] + radius);
  }
  constexpr int halvings = 50;
  for (int halving = 0; halving < halvings; ++halving) {
    const double middle = 0.5 * (low + high);
    (is_above(middle) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// In −1 … 1, equal for all compilers (splitmix64 of k).
inline double scattered(std::uint64_t k) {
  k = (k + 1) * 0x9e3779b97f4a7c15;
  k = (k ^ k >> 30) * 0xbf58476d1ce4e5b9;
  k = (k ^ k >> 27) * 0x94d049bb133111eb;
  return static_cast<double>(k ^ k >> 31) * 0x1p-63 - 1;
}

/// Equal for any number of threads.
template <int Dim>
double dot(const std::vector<Vec<double, Dim>>& a, const std::vector<Vec<double, Dim>>& b, int threads) {
  constexpr int stretch = 1024;
  const int n = static_cast<int>(a.size());
  std::vector<double> sums((n + stretch - 1) / stretch);
  parallel_for(static_cast<int>(sums.size()), threads, [&](int s) {
    for (int i = stretch * s; i < std::min(stretch * (s + 1), n); ++i) sums[s] += dot(a[i], b[i]);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// Maximum eigenvalue of a symmetric operator apply(u, out) on n vectors, about 0.5 % low, by Lanczos steps from a
/// fixed start.
template <int Dim, class Apply>
double greatest_eigenvalue(int n, int threads, const Apply& apply) {
  constexpr int least = 14, most = 30;  // steps
  constexpr double enough = 5e-4;       // relative growth per step
  using Field = std::vector<Vec<double, Dim>>;
  Field before(n), u(n), next(n);
  parallel_for(n, threads, [&](int i) {
    for (int k = 0; k < Dim; ++k) u[i][k] = scattered(static_cast<std::uint64_t>(Dim) * i + k);
  });
  double greatest = 0, length = std::sqrt(dot(u, u, threads));
  std::vector<double> diagonal, beside;
  for (int step = 1;; ++step) {
    parallel_for(n, threads, [&](int i) { u[i] = (1 / length) * u[i]; });
    apply(u, next);
    diagonal.push_back(dot(u, next, threads));
    const double last = std::exchange(greatest, greatest_eigenvalue(diagonal, beside));
    if (step == most || (step >= least && !(greatest - last > enough * greatest))) return greatest;
    const double along = diagonal.back(), back = beside.empty() ? 0 : beside.back();
    parallel_for(n, threads, [&](int i) { next[i] -= along * u[i] + back * before[i]; });
    length = std::sqrt(dot(next, next, threads));
    if (!(length > 0)) return greatest;
    beside.push_back(length);
    before.swap(u), u.swap(next);
  }
}

/// In 1/s², with stiffness from differences of forces. `mobility`: 1/kg, 0 if immovable.
/// forces(u, out) writes forces in N at displacements |u| ≤ `small`, m.
template <int Dim, class Forces>
double highest_frequency_squared(const std::vector<double>& mobility, double small, int threads,
                                 const Forces& forces) {
  using Field = std::vector<Vec<double, Dim>>;
  const int n = static_cast<int>(mobility.size());
  std::vector<double> root(mobility.size());
  parallel_for(n, threads, [&](int i) { root[i] = std::sqrt(mobility[i]); });
  Field moved(n), rest(n);
  forces(moved, rest);
  return greatest_eigenvalue<Dim>(n, threads, [&](const Field& u, Field& out) {
    parallel_for(n, threads, [&](int i) { moved[i] = root[i] * u[i]; });
    const double farthest =
        std::sqrt(parallel_max(n, threads, [&](int i) { return dot(moved[i], moved[i]); }));
    const double scale = farthest > 0 ? small / farthest : 1;
    parallel_for(n, threads, [&](int i) { moved[i] = scale * moved[i]; });
    forces(moved, out);
    parallel_for(n, threads, [&](int i) { out[i] = (root[i] / scale) * (rest[i] - out[i]); });
  });
}

}  // namespace taut
