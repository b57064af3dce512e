#include "engine/scene/material_point.hpp"

#include <array>
#include <cmath>

namespace taut {
namespace {

constexpr std::size_t most = 4;  // 1 and three components
using Basis = std::array<double, most>;
using Equations = std::array<std::array<double, most + 1>, most>;

/// Solves for the right side in the last column; false if the matrix is singular.
bool solve(Equations& A, std::size_t n) {
  constexpr double least_pivot = 1e-9;  // of the matrix's weights: a line of particles has none across it
  const double scale = A[0][0];
  for (std::size_t k = 0; k < n; ++k) {
    if (!(std::abs(A[k][k]) > least_pivot * scale)) return false;
    for (std::size_t row = 0; row < n; ++row) {
      if (row == k) continue;
      const double factor = A[row][k] / A[k][k];
      for (std::size_t l = k; l <= n; ++l) A[row][l] -= factor * A[k][l];
    }
  }
  return true;
}

}  // namespace

std::vector<PointWeight> material_point(const std::vector<Point>& x, int begin, int end, const Point& at,
                                        double reach, int dim) {
  const std::size_t n = static_cast<std::size_t>(dim) + 1;
  Equations A{};
  std::vector<PointWeight> point;
  std::vector<Basis> bases;
  for (int i = begin; i < end; ++i) {
    Basis b{1};
    double r2 = 0;
    for (std::size_t k = 1; k < n; ++k) {
      b[k] = (x[static_cast<std::size_t>(i)][k - 1] - at[k - 1]) / reach;
      r2 += b[k] * b[k];
    }
    if (r2 >= 1) continue;
    const double w = (1 - r2) * (1 - r2);
    point.push_back({i, w});
    bases.push_back(b);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t l = 0; l < n; ++l) A[k][l] += w * b[k] * b[l];
  }
  A[0][n] = 1;
  if (point.size() < n || !solve(A, n)) return {};
  for (std::size_t p = 0; p < point.size(); ++p) {
    double shape = 0;
    for (std::size_t k = 0; k < n; ++k) shape += bases[p][k] * A[k][n] / A[k][k];
    point[p].weight *= shape;
  }
  return point;
}

}  // namespace taut
