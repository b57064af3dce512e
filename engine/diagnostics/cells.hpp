#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/core/point.hpp"
#include "engine/neighbors/affine_fit.hpp"

namespace taut {

struct CellShapes {
  std::vector<std::size_t> particle;  // [cell]
  std::vector<double> centre;         // [cell] dim coordinates, m
  std::vector<double> edge;           // [cell] dim vectors, m
};

/// Cells are initially boxes. Each cell moves with the best affine map of the initial neighbours.
class Cells {
 public:
  /// `x0`: n × dim, m; `diameter` in m.
  Cells(int dim, std::span<const double> x0, std::span<const double> diameter, std::span<const int> body);

  /// Copies axes and ends.
  void take_ends(const Cells& all, std::span<const std::size_t> shown);

  /// Shapes at positions `x`, n × dim, m; in 3D without hidden cells.
  CellShapes at(std::span<const double> x) const;

 private:
  struct Side {
    Point axis{};              // unit vector
    double low = 0, high = 0;  // ends, from the particle, m
  };
  struct Cell {
    std::array<Side, 3> sides;
    LinearMap inverse{};  // of Σ X_ij ⊗ X_ij, 1/m²
    double spacing = 0;   // distance of the nearest neighbour, m
    bool inside = false;  // has a neighbour on each side
    bool thin = false;    // see is_thin
  };

  Point initial(std::size_t i, std::size_t j) const;  // m
  std::span<const std::size_t> neighbors(std::size_t i) const;
  void find_axes(std::size_t i);
  void find_ends(std::size_t i, double diameter);
  LinearMap moment(std::size_t i) const;  // of the neighbours, m²
  void find_inverse(std::size_t i);
  void forget_distant();
  Point change(std::size_t i, std::size_t j, std::span<const double> x) const;  // m
  bool is_hidden(std::size_t i, std::span<const double> x) const;

  std::size_t dim_;
  std::vector<double> x0_;
  std::vector<std::size_t> first_, neighbor_;
  std::vector<Cell> cells_;
};

}  // namespace taut
