#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "engine/core/point.hpp"

namespace taut {

struct Bounds {
  Point low{}, high{};

  Point middle() const {
    return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])};
  }
};

Bounds joined(Bounds a, const Bounds& b);

/// Bounding box of the corners of a box, moved by `place`.
template <class Place>
Bounds bounds_of_placed(const Bounds& box, const Place& place) {
  Bounds all;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Point x = box.low;
    for (unsigned k = 0; k < 3; ++k)
      if (corner >> k & 1) x[k] = box.high[k];
    const Point y = place(x);
    all = corner == 0 ? Bounds{y, y} : joined(all, {y, y});
  }
  return all;
}

/// Closed chain of points on a face, m.
using Chain = std::vector<Point>;

/// Faces of a 3D body: quadrilaterals with corners exactly on them.
struct FacePatches {
  struct Patch {
    std::array<int, 4> node{};  // anticlockwise, seen from outside
    int site = 0;               // index of the site behind it
  };
  std::vector<Point> node;  // m
  std::vector<Patch> patches;
};

struct InitialSite {
  Point x{};                      // m
  double V0 = 0;                  // m^dim
  int turned = -1;                // next site under the symmetry rotation of a round body; -1 = none
  double inside = 1;              // fraction of the cell inside the body
  std::array<bool, 3> on_face{};  // on a face normal to this axis
  Point middle{};                 // x without jitter, m; decides which regions contain it
};

/// Interface of the shapes in engine/scene/shapes/. Lengths are in m; components beyond `dim` are ignored.
/// A shape can place particles in layers along its faces: lattice steps at curved faces cause strain errors that do
/// not fall with the spacing.
struct ShapeBase {
  virtual ~ShapeBase() = default;
  bool operator==(const ShapeBase&) const = default;

  virtual Bounds bounds() const = 0;
  /// Whether x is inside, or at most `tolerance` outside.
  virtual bool holds(const Point& x, int dim, double tolerance) const = 0;
  virtual void shift(std::size_t axis, double by) = 0;
  /// Area or volume, m^dim; an upper bound if not exact.
  virtual double measure(int dim) const = 0;
  virtual bool has_exact_measure() const;
  /// Extent that must hold a whole number of particles, m; 0 = none.
  virtual double thinnest(int dim) const;
  /// Centre of reflections and rotations.
  virtual Point middle() const;
  /// Corner of the lattice of a body with this first shape.
  virtual Point anchor() const;
  /// Particles of a body of this shape alone; empty = filled by the lattice.
  virtual std::vector<InitialSite> sites(int dim, double dp) const;
  /// Faces in 2D: points on them about dp apart and at corners, solid on the left. Empty in 3D.
  virtual std::vector<Chain> outline(int dim, double dp) const;
  /// Faces in 3D of a shape that places its particles; else empty.
  virtual FacePatches patches(double dp) const;
  /// For rotated lattices: lattice to space, space to lattice, and bounds along the lattice axes.
  virtual Point from_lattice(const Point& x) const;
  virtual Point to_lattice(const Point& x) const;
  virtual Bounds lattice_bounds() const;
};

/// A shape of any kind; copies share it.
class Shape {
 public:
  template <std::derived_from<ShapeBase> S>
  Shape(S shape)
      : base_(std::make_shared<const S>(std::move(shape))),
        copy_([](const ShapeBase& of) -> std::shared_ptr<ShapeBase> {
          return std::make_shared<S>(static_cast<const S&>(of));
        }) {}

  const ShapeBase* operator->() const { return base_.get(); }
  /// nullptr if it is another kind.
  template <class S>
  const S* as() const {
    return dynamic_cast<const S*>(base_.get());
  }
  void shift(std::size_t axis, double by) {
    const auto moved = copy_(*base_);
    moved->shift(axis, by);
    base_ = moved;
  }

 private:
  std::shared_ptr<const ShapeBase> base_;
  std::shared_ptr<ShapeBase> (*copy_)(const ShapeBase&);
};

}  // namespace taut
