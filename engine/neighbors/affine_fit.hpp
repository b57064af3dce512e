#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/core/point.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// 3 × 3, row by row.
using LinearMap = std::array<double, 9>;

struct InitialPositions {
  int dim = 2;
  std::span<const double> x0;        // n × dim, m
  std::span<const double> diameter;  // m
  std::span<const int> body;

  /// X_j − X_i, m
  Point way(std::size_t i, std::size_t j) const;
  double distance(std::size_t i, std::size_t j) const;  // m
};

/// Neighbours in the same body, up to 1.6 times the distance of the nearest.
struct FirstNeighbors {
  std::vector<std::size_t> first, neighbor;
  std::vector<double> spacing;  // distance of the nearest, m; 1e300 = none

  std::span<const std::size_t> operator[](std::size_t i) const {
    return std::span(neighbor).subspan(first[i], first[i + 1] - first[i]);
  }
};
FirstNeighbors first_neighbors(const InitialPositions& start);

/// Regularised inverse of Σ X ⊗ X, 1/m²; in 2D with 1 for the third axis.
LinearMap inverse_moment(const LinearMap& moment, int dim);

/// Whether a body is one particle thick, so that Σ X ⊗ X has no inverse.
bool is_thin(const LinearMap& moment, int dim);
/// F of a thin body: directions across the body turn with it, without strain.
LinearMap turned_across(const LinearMap& F, const LinearMap& moment, int dim);

/// Least-squares F from the first neighbours, in 2D with F_zz = 1. Meaningless where a body has torn.
std::vector<LinearMap> affine_maps(const Snapshot& now);

}  // namespace taut
