#pragma once

#include <functional>
#include <span>
#include <vector>

#include "tests/references/material.hpp"
#include "tests/references/quadrature.hpp"

namespace references {

template <int d>
constexpr int points_per_element = d == 2 ? n* n : n* n* n;

/// Quadrilaterals or hexahedra of order 4, in m. The first axis varies fastest among the nodes of an element.
template <int d>
struct Mesh {
  std::vector<Vector<d>> nodes;
  std::vector<std::array<int, points_per_element<d>>> elements;
};

/// Bounds of `count` equal elements from `low` to `high`. The first element is halved `at_low` times towards `low`, the
/// last element `at_high` times towards `high`.
inline std::vector<double> axis(double low, double high, int count, int at_low = 0, int at_high = 0) {
  std::vector<double> bounds = {low};
  const double size = (high - low) / count;
  for (int k = at_low; k > 0; --k) bounds.push_back(low + std::ldexp(size, -k));
  for (int i = 1; i < count; ++i) bounds.push_back(low + i * size);
  for (int k = 1; k <= at_high; ++k) bounds.push_back(high - std::ldexp(size, -k));
  bounds.push_back(high);
  return bounds;
}

/// Elements between the bounds along each axis; `map` moves their nodes to the initial configuration.
template <int d>
Mesh<d> grid(
    const std::array<std::vector<double>, d>& bounds,
    const std::function<Vector<d>(const Vector<d>&)>& map = [](const Vector<d>& x) { return x; }) {
  const Row points = gauss_lobatto().points;
  std::array<std::vector<double>, d> lines;
  int elements = 1, nodes = 1;
  for (int a = 0; a < d; ++a) {
    const auto& ends = bounds[a];
    for (std::size_t e = 0; e + 1 < ends.size(); ++e)
      for (int i = 0; i < order; ++i)
        lines[a].push_back(ends[e] + (points[i] + 1) / 2 * (ends[e + 1] - ends[e]));
    lines[a].push_back(ends.back());
    elements *= static_cast<int>(ends.size()) - 1;
    nodes *= static_cast<int>(lines[a].size());
  }
  Mesh<d> mesh;
  for (int node = 0; node < nodes; ++node) {
    Vector<d> x;
    for (int a = 0, rest = node; a < d; ++a) {
      const int count = static_cast<int>(lines[a].size());
      x[a] = lines[a][rest % count];
      rest /= count;
    }
    mesh.nodes.push_back(map(x));
  }
  for (int element = 0; element < elements; ++element) {
    std::array<int, points_per_element<d>> element_nodes;
    for (int point = 0; point < points_per_element<d>; ++point) {
      int node = 0, stride = 1;
      for (int a = 0, rest = element, place = point; a < d; ++a) {
        const int count = static_cast<int>(bounds[a].size()) - 1;
        node += stride * (rest % count * order + place % n);
        stride *= static_cast<int>(lines[a].size());
        rest /= count;
        place /= n;
      }
      element_nodes[point] = node;
    }
    mesh.elements.push_back(element_nodes);
  }
  return mesh;
}

/// Multiplies an element's values by `matrix` along one axis.
template <int d, int along, class T>
inline void multiply(const Matrix& matrix, const T* in, T* out) {
  constexpr int stride = along == 0 ? 1 : along == 1 ? n : n * n;
  for (int base = 0; base < points_per_element<d>; base += stride * n)
    for (int first = base; first < base + stride; ++first) {
      T line[n];
      for (int i = 0; i < n; ++i) line[i] = in[first + i * stride];
      for (int i = 0; i < n; ++i) {
        T sum = matrix[i][0] * line[0];
        for (int j = 1; j < n; ++j) sum += matrix[i][j] * line[j];
        out[first + i * stride] = sum;
      }
    }
}

/// Along every axis, in place.
template <int d, class T>
inline void multiply_all(const Matrix& matrix, T* values) {
  multiply<d, 0>(matrix, values, values);
  multiply<d, 1>(matrix, values, values);
  if constexpr (d == 3) multiply<d, 2>(matrix, values, values);
}

template <int d, class T>
inline void multiply(const Matrix& matrix, int a, const T* in, T* out) {
  if (a == 0) return multiply<d, 0>(matrix, in, out);
  if (a == 1) return multiply<d, 1>(matrix, in, out);
  if constexpr (d == 3) multiply<d, 2>(matrix, in, out);
}

}  // namespace references
