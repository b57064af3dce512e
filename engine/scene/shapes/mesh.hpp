#pragma once

#include <array>
#include <span>

#include "engine/scene/shape.hpp"

namespace taut {

/// Corners are anticlockwise, seen from outside.
struct Triangles {
  std::vector<Point> points;  // m
  std::vector<std::array<int, 3>> corners;
};

/// Number of edges with an odd number of triangles (`open`), and of other edges whose triangles face opposite sides.
struct MeshFaults {
  int open = 0, turned = 0;
};
MeshFaults faults_of(const Triangles& mesh);

/// Region where the winding number of a closed mesh is not 0.
class Mesh final : public ShapeBase {
 public:
  /// The mesh must have no faults.
  explicit Mesh(Triangles mesh);

  Bounds bounds() const override;
  bool holds(const Point& x, int dim, double tolerance) const override;
  double measure(int) const override { return volume_; }  // counts overlaps of parts repeatedly
  void shift(std::size_t axis, double by) override { from_[axis] += by; }

 private:
  using Range = std::array<int, 2>;

  Range cells(std::size_t axis, double low, double high) const;
  template <class Visit>
  void visit_near(const Point& x, double distance, const Visit& visit) const;
  int winding_number(const Point& x) const;
  bool is_within(double distance, const Point& x) const;

  Triangles mesh_;
  Point from_{};
  Bounds box_{};
  double volume_ = 0;  // m³
  std::array<int, 2> sides_{1, 1};
  std::vector<std::vector<int>> triangles_;
};

}  // namespace taut
