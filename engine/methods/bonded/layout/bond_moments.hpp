#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "engine/core/least_squares.hpp"

namespace taut {

/// Fourth moments of bonds and their isotropic targets (THEORY.md, Bonds).
template <int Dim>
class Moments {
 public:
  Moments() {
    std::array<int, Dim> powers{};
    fill(powers, 0, 4);
    for (int m = 0; m < count; ++m) target_[m] = isotropic(powers_[m]);
  }

  /// Satisfies the targets by the least change of w. Returns false if no such w ≥ 0 is found; w is then a fit.
  bool make_right(const std::vector<Eigen::Vector<double, Dim>>& X, std::vector<double>& w) const {
    std::vector<Vector> M(X.size());
    for (std::size_t b = 0; b < X.size(); ++b) M[b] = of(X[b].normalized());
    if (Dim == 3 && is_right(M, w)) return true;
    correct(M, w);
    return is_right(M, w);
  }

 private:
  static constexpr int count = Dim == 2 ? 5 : 15;
  using Vector = Eigen::Vector<double, count>;

  void fill(std::array<int, Dim>& powers, int axis, int left) {
    powers[axis] = left;
    if (axis == Dim - 1) return powers_.push_back(powers);
    for (; powers[axis] >= 0; --powers[axis]) fill(powers, axis + 1, left - powers[axis]);
  }
  static double isotropic(const std::array<int, Dim>& powers) {
    double value = 1;
    for (int p : powers) value *= p % 2 == 1 ? 0 : (p == 4 ? 3 : 1);
    return value;
  }
  Vector of(const Eigen::Vector<double, Dim>& e) const {
    std::array<std::array<double, 5>, Dim> power;
    for (int k = 0; k < Dim; ++k)
      power[k] = {1, e[k], e[k] * e[k], e[k] * e[k] * e[k], e[k] * e[k] * e[k] * e[k]};
    Vector moments;
    for (int m = 0; m < count; ++m) {
      moments[m] = 1;
      for (int k = 0; k < Dim; ++k) moments[m] *= power[k][powers_[m][k]];
    }
    return moments;
  }
  Vector missing(const std::vector<Vector>& M, const std::vector<double>& w) const {
    Vector sum = target_;
    for (std::size_t b = 0; b < M.size(); ++b) sum -= w[b] * M[b];
    return sum;
  }
  bool is_right(const std::vector<Vector>& M, const std::vector<double>& w) const {
    return missing(M, w).cwiseAbs().maxCoeff() < 1e-9;
  }
  /// Solves w = ω ∘ (1 + Mᵀ α) with M w = target. Negative weights become 0.
  void correct(const std::vector<Vector>& M, std::vector<double>& omega) const {
    std::vector<double> w(omega.size());
    for (std::size_t round = 0; round <= omega.size(); ++round) {
      Eigen::Matrix<double, count, count> A = Eigen::Matrix<double, count, count>::Zero();
      for (std::size_t b = 0; b < M.size(); ++b)
        for (int k = 0; k < count; ++k) A.col(k) += omega[b] * M[b][k] * M[b];
      const Vector short_of = missing(M, omega);
      const Gram fast = solved_by_gram(A, short_of);
      const Vector alpha = fast.size() > 0 ? Vector(fast) : Vector(least_squares(A, short_of).x);
      bool negative = false;
      for (std::size_t b = 0; b < M.size(); ++b) {
        w[b] = omega[b] + omega[b] * M[b].dot(alpha);
        negative = negative || w[b] < 0;
      }
      if (!negative) return omega.swap(w);
      for (std::size_t b = 0; b < M.size(); ++b)
        if (w[b] < 0) omega[b] = 0;
    }
  }

  std::vector<std::array<int, Dim>> powers_;
  Vector target_;
};

/// Weights of mirror images get equal bits.
inline double rounded_weight(double weight) { return std::ldexp(std::round(std::ldexp(weight, 36)), -36); }

}  // namespace taut
