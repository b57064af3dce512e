#include "tests/references/quadrature.hpp"

#include <cmath>

namespace references {

Rule gauss() {
  const double root = 2 * std::sqrt(10. / 7), weight = 13 * std::sqrt(70.);
  const double far = std::sqrt(5 + root) / 3, near = std::sqrt(5 - root) / 3;
  const double light = (322 - weight) / 900, heavy = (322 + weight) / 900;
  return {{-far, -near, 0, near, far}, {light, heavy, 128. / 225, heavy, light}};
}

Rule gauss_lobatto() {
  const double near = std::sqrt(3. / 7);
  return {{-1, -near, 0, near, 1}, {1. / 10, 49. / 90, 32. / 45, 49. / 90, 1. / 10}};
}

Matrix interpolation(const Row& from, const Row& to) {
  Matrix matrix;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      matrix[i][j] = 1;
      for (int k = 0; k < n; ++k)
        if (k != j) matrix[i][j] *= (to[i] - from[k]) / (from[j] - from[k]);
    }
  return matrix;
}

Matrix derivative(const Row& points) {
  Matrix matrix{};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int l = 0; l < n; ++l) {
        if (l == j) continue;
        double term = 1 / (points[j] - points[l]);
        for (int k = 0; k < n; ++k)
          if (k != j && k != l) term *= (points[i] - points[k]) / (points[j] - points[k]);
        matrix[i][j] += term;
      }
  return matrix;
}

Matrix transposed(const Matrix& matrix) {
  Matrix result;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) result[i][j] = matrix[j][i];
  return result;
}

}  // namespace references
