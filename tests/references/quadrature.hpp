#pragma once

#include <array>

namespace references {

/// Order of the elements, and number of their nodes and quadrature points along each axis.
constexpr int order = 4, n = order + 1;

using Row = std::array<double, n>;
using Matrix = std::array<Row, n>;

/// Points in [-1, 1].
struct Rule {
  Row points, weights;
};

Rule gauss();          ///< exact for polynomials of degree 2 n - 1; no end points
Rule gauss_lobatto();  ///< exact for degree 2 n - 3; the nodes of an element

/// Values at `to` of the polynomials that are 1 at one of the points `from` and 0 at the others: [to][from].
Matrix interpolation(const Row& from, const Row& to);

/// Derivatives at `points` of the same polynomials: [point][polynomial].
Matrix derivative(const Row& points);

Matrix transposed(const Matrix& matrix);

}  // namespace references
