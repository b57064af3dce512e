#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/core/point.hpp"

namespace taut {

/// Parallelograms, in 3D boxes, that bodies consist of at one time.
struct CellShapes {
  std::vector<std::size_t> particle;  // whose cell it is
  std::vector<double> centre;         // dim coordinates each, m
  std::vector<double> edge;           // dim vectors each, m
};

/// The part of its body that each particle stands for: at the start a rectangle or a box with sides half-way
/// to its adjacent neighbours, later what an affine map makes of that. The map is the one that takes the
/// particle's initial neighbours of the same body, up to 1.6 spacings away, nearest to where they are (least
/// squares). It needs nothing of the method; gaps between neighbouring cells are of second order in the
/// spacing.
///
/// Particles that stand on the boundary of a body have their half, quarter or eighth of a cell inside.
class Cells {
 public:
  /// Initial positions (n × dim, m), diameters (m) and bodies of the particles.
  Cells(int dim, std::span<const double> x0, std::span<const double> diameter, std::span<const int> body);

  /// Particle k is shown[k] of `all`, whose others are cut away: its cell ends where it did among them.
  void take_ends(const Cells& all, std::span<const std::size_t> shown);

  /// For these positions, n × dim, m. In 3D without the cells that others surround on all sides.
  CellShapes at(std::span<const double> x) const;

 private:
  /// Along one axis of a cell at the start.
  struct Side {
    Point axis{};              // of length 1
    double low = 0, high = 0;  // its ends, from the particle, m
  };
  struct Cell {
    std::array<Side, 3> sides;
    std::array<double, 9> inverse{};  // of the moment Σ X_ij ⊗ X_ij, 1/m²
    double spacing = 0;               // m
    bool inside = false;              // covered on all sides
  };

  Point initial(std::size_t i, std::size_t j) const;  // X_j − X_i, m
  std::span<const std::size_t> neighbors(std::size_t i) const;
  void find_axes(std::size_t i);
  void find_ends(std::size_t i, double diameter);
  void find_inverse(std::size_t i);
  void forget_distant();
  Point change(std::size_t i, std::size_t j, std::span<const double> x) const;  // m
  bool is_hidden(std::size_t i, std::span<const double> x) const;

  std::size_t dim_;
  std::vector<double> x0_;
  std::vector<std::size_t> first_, neighbor_;  // of particle i: from first_[i] to first_[i + 1]
  std::vector<Cell> cells_;
};

}  // namespace taut
