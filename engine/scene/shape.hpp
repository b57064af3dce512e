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

/// The smallest box around both.
Bounds joined(Bounds a, const Bounds& b);

/// The smallest box around the places to which `place` moves the corners of a box.
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

/// Points on a face, m, one after the other; the first follows the last.
using Chain = std::vector<Point>;

/// The faces of a body in 3D: quadrilaterals, whose corners lie exactly on them.
struct FacePatches {
  struct Patch {
    std::array<int, 4> node{};  // against the clock, seen from outside
    int site = 0;               // of `sites`, that it lies in front of
  };
  std::vector<Point> node;  // m
  std::vector<Patch> patches;
};

/// A particle at t = 0.
struct InitialSite {
  Point x{};          // m
  double V0 = 0;      // m^dim
  int turned = -1;    // the next site under the symmetry rotation of a round body; -1: no symmetry
  double inside = 1;  // fraction of its cell inside the body
  std::array<bool, 3> on_face{};  // whether it lies on a face normal to this axis
  Point middle{};                 // x without jitter, m; decides which regions contain the particle
};

/// Interface of all shapes; each is a struct of engine/scene/shapes/ that derives from it. Lengths are in m;
/// components beyond `dim` are ignored.
///
/// A shape can lay its own particles in layers along its faces. The strain is then smooth up to a curved face; the steps
/// of a lattice would leave noise there that does not fall with the spacing.
struct ShapeBase {
  virtual ~ShapeBase() = default;
  bool operator==(const ShapeBase&) const = default;

  /// The smallest box around the shape.
  virtual Bounds bounds() const = 0;
  /// x lies inside, or at most `tolerance` outside.
  virtual bool holds(const Point& x, int dim, double tolerance) const = 0;
  /// Moves the shape along an axis.
  virtual void shift(std::size_t axis, double by) = 0;
  /// Area or volume, m^dim; an upper bound if not exact.
  virtual double measure(int dim) const = 0;
  virtual bool has_exact_measure() const;
  /// The extent that must hold a whole number of particles, m; 0: none.
  virtual double thinnest(int dim) const;
  /// The centre of reflections and rotations.
  virtual Point middle() const;
  /// A corner of the lattice of a body whose first shape this is.
  virtual Point anchor() const;
  /// The particles of a body of this shape alone; empty if the lattice fills it.
  virtual std::vector<InitialSite> sites(int dim, double dp) const;
  /// Faces in 2D: closed chains of points exactly on the faces, about dp apart, with the solid on the left. Each corner
  /// is a point. Empty in 3D.
  virtual std::vector<Chain> outline(int dim, double dp) const;
  /// The outline of a part of a combined shape. Combined parts make their own parts finer, but never finer than
  /// `finest`: else each level of shapes in shapes would multiply the points.
  virtual std::vector<Chain> outline_of_part(int dim, double dp, double finest) const;
  /// Faces in 3D of a shape that lays its own particles; else empty.
  virtual FacePatches patches(double dp) const;
  /// For shapes that turn the lattice: from lattice to space, from space to lattice, and the box around the shape along
  /// the axes of the lattice.
  virtual Point from_lattice(const Point& x) const;
  virtual Point to_lattice(const Point& x) const;
  virtual Bounds lattice_bounds() const;
};

/// A shape of any kind, as in `Shape shape = Disc(centre, radius); shape->bounds()`. Copies share it.
class Shape {
 public:
  template <std::derived_from<ShapeBase> S>
  Shape(S shape)
      : base_(std::make_shared<const S>(std::move(shape))),
        copy_([](const ShapeBase& of) -> std::shared_ptr<ShapeBase> {
          return std::make_shared<S>(static_cast<const S&>(of));
        }) {}

  const ShapeBase* operator->() const { return base_.get(); }
  /// nullptr if the shape is of another kind.
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
