#pragma once

#include <array>
#include <cstddef>

namespace taut {

/// Nodes and Gauss points of a line element on [−1, 1]. Elements are products of lines, numbered along axis 0 first.
template <int n>
struct LineElement {
  static_assert(n == 2 || n == 3);
  using Row = std::array<double, n>;
  using Table = std::array<Row, n>;

  // Gauss–Lobatto
  static constexpr Row node = [] {
    if constexpr (n == 2)
      return Row{-1, 1};
    else
      return Row{-1, 0, 1};
  }();
  static constexpr Row node_weight = [] {
    if constexpr (n == 2)
      return Row{1, 1};
    else
      return Row{1.0 / 3, 4.0 / 3, 1.0 / 3};
  }();
  static constexpr Row gauss = [] {
    if constexpr (n == 2)
      return Row{-0.57735026918962576451, 0.57735026918962576451};
    else
      return Row{-0.77459666924148337704, 0, 0.77459666924148337704};
  }();
  static constexpr Row gauss_weight = [] {
    if constexpr (n == 2)
      return Row{1, 1};
    else
      return Row{5.0 / 9, 8.0 / 9, 5.0 / 9};
  }();

  /// Lagrange polynomial of point a of `at`.
  static constexpr double value(const Row& at, std::size_t a, double x) {
    double product = 1;
    for (std::size_t k = 0; k < n; ++k)
      if (k != a) product *= (x - at[k]) / (at[a] - at[k]);
    return product;
  }
  static constexpr double slope(const Row& at, std::size_t a, double x) {
    double sum = 0;
    for (std::size_t l = 0; l < n; ++l) {
      if (l == a) continue;
      double product = 1 / (at[a] - at[l]);
      for (std::size_t k = 0; k < n; ++k)
        if (k != a && k != l) product *= (x - at[k]) / (at[a] - at[k]);
      sum += product;
    }
    return sum;
  }

  template <class F>
  static constexpr Table table(const F& f) {
    Table t{};
    for (std::size_t row = 0; row < n; ++row)
      for (std::size_t a = 0; a < n; ++a) t[row][a] = f(row, a);
    return t;
  }
  // [Gauss point][node]
  static constexpr Table N = table([](std::size_t q, std::size_t a) { return value(node, a, gauss[q]); });
  static constexpr Table dN = table([](std::size_t q, std::size_t a) { return slope(node, a, gauss[q]); });
  // [node][node]
  static constexpr Table dN_at_nodes =
      table([](std::size_t b, std::size_t a) { return slope(node, a, node[b]); });
  // [node][Gauss point]: extrapolation
  static constexpr Table at_nodes =
      table([](std::size_t a, std::size_t q) { return value(gauss, q, node[a]); });
};

constexpr int power_of(int n, int dim) { return dim == 2 ? n * n : n * n * n; }

/// Index along `axis` of node or Gauss point k in an element with n per axis.
constexpr int index_along(int axis, int k, int n) {
  return axis == 0 ? k % n : axis == 1 ? k / n % n : k / (n * n);
}

template <int n, int Dim>
constexpr double product_weight(const std::array<double, n>& weight, int k) {
  double product = 1;
  for (int axis = 0; axis < Dim; ++axis) product *= weight[static_cast<std::size_t>(index_along(axis, k, n))];
  return product;
}

template <class F>
auto with_order(int order, const F& f) {
  return order == 1 ? f(std::integral_constant<int, 2>{}) : f(std::integral_constant<int, 3>{});
}

}  // namespace taut
