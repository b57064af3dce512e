#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/core/point.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// A linear map in space, row by row.
using LinearMap = std::array<double, 9>;

/// Where particles were at the start, and which body they belong to.
struct Layout {
  int dim = 2;
  std::span<const double> x0;        // n × dim, m
  std::span<const double> diameter;  // m
  std::span<const int> body;

  /// X_j − X_i, m
  Point way(std::size_t i, std::size_t j) const;
  double distance(std::size_t i, std::size_t j) const;  // m
};

/// Of each particle those of its body that were at most 1.6 times as far from it as the nearest.
struct FirstNeighbors {
  std::vector<std::size_t> first, neighbor;  // of particle i: from first[i] to first[i + 1]
  std::vector<double> spacing;               // to the nearest, m

  std::span<const std::size_t> operator[](std::size_t i) const {
    return std::span(neighbor).subspan(first[i], first[i + 1] - first[i]);
  }
};
FirstNeighbors first_neighbors(const Layout& start);

/// The inverse of the moment Σ X ⊗ X of ways to neighbours, 1/m². In 2D the third axis is left alone, and so
/// is what lies across a body that is one particle thick.
LinearMap inverse_moment(const LinearMap& moment, int dim);

/// The affine map F that takes the first neighbours of a particle nearest to where they are now (least
/// squares): F = 1 + Σ (x_ij − X_ij) ⊗ X_ij (Σ X_ij ⊗ X_ij)⁻¹. It is exact for an affine motion, needs
/// nothing of the method, and means little where a body has torn. In 2D F_zz = 1 (plane strain).
std::vector<LinearMap> affine_maps(const Snapshot& now);
/// That of one particle, which costs a look at all others.
LinearMap affine_map(const Snapshot& now, std::size_t i);

}  // namespace taut
