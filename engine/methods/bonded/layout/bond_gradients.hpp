#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "engine/core/parallel.hpp"
#include "engine/methods/bonded/layout/bonds.hpp"

namespace taut {

template <int Dim>
Eigen::Vector<double, Dim> vector_of(const Point& p) {
  return Eigen::Map<const Eigen::Vector<double, Dim>>(p.data());
}
template <int Dim>
Point point_of(const Eigen::Vector<double, Dim>& v) {
  Point p{};
  for (int k = 0; k < Dim; ++k) p[k] = v[k];
  return p;
}

/// Rounds to float bitwise: GCC 12 removes casts to float in vectorised loops.
inline double single_precision(double a) {
  constexpr std::uint64_t dropped = 1ULL << 29;
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(a) + dropped / 2) & ~(dropped - 1));
}

/// B of n particles (THEORY.md, Gradient).
template <int Dim>
std::vector<InverseMoment> inverse_moments(const Bonds& bonds, int n, int threads) {
  std::vector<InverseMoment> B(n);
  parallel_for(n, threads, [&](int i) {
    using Square = Eigen::Matrix<double, Dim, Dim>;
    Square A = Square::Zero();
    bonds.for_each(i, [&](int, const ReferenceBond& bond) {
      A += vector_of<Dim>(bond.area) * vector_of<Dim>(bond.X).transpose();
    });
    const double of_isotropic = std::pow(A.trace() / Dim, Dim);
    constexpr double least = 0.1;
    if (!(A.determinant() > least * of_isotropic)) return;
    const Square inverse = A.inverse();
    for (int k = 0; k < Dim; ++k) B[i][k] = point_of<Dim>(inverse.col(k));
  });
  return B;
}

/// Surface S_j (THEORY.md, Volumes and masses) for volumes V in m^dim.
inline std::vector<Point> surface_of(const Bonds& bonds, const std::vector<InverseMoment>& B,
                                     const std::vector<double>& V) {
  std::vector<Point> S(V.size());
  for (int i = 0; i < static_cast<int>(V.size()); ++i) {
    bonds.for_each(i, [&](int j, const ReferenceBond& bond) {
      const Point g = gradient_of(B[i], bond);
      for (std::size_t k = 0; k < g.size(); ++k) {
        S[j][k] += V[i] * g[k];
        S[i][k] -= V[i] * g[k];
      }
    });
  }
  return S;
}

}  // namespace taut
