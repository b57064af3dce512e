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
  Point low{}, high{};  // m

  Point middle() const {
    return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])};
  }
};

Bounds joined(Bounds a, const Bounds& b);

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

/// Quadrilaterals whose corners lie exactly on the faces of a body.
struct FacePatches {
  struct Patch {
    std::array<int, 4> node{};  // anticlockwise, seen from outside
    int site = 0;               // index of the particle site behind it
  };
  std::vector<Point> node;  // m
  std::vector<Patch> patches;
};

struct InitialSite {
  Point x{};          // m
  double V0 = 0;      // m^dim
  int turned = -1;    // site onto which a symmetry rotation maps this site; -1 = none
  double inside = 1;  // fraction of its cell that lies in the body
  std::array<bool, 3> on_face{};
  Point middle{};  // x without jitter, m; for regions
};

/// Lengths are in m; components beyond `dim` are ignored.
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
  /// Extent to divide into whole particles or rows, m; 0 = none.
  virtual double extent_to_divide(int dim) const;
  /// Centre of reflections, m.
  virtual Point middle() const;
  virtual Point anchor() const;
  /// Sites in a body that has only this shape; empty if the lattice fills the body.
  virtual std::vector<InitialSite> sites(int dim, double dp) const;
  /// Points are about dp apart and at each corner, with the solid on the left. Empty in 3D.
  virtual std::vector<Chain> outline(int dim, double dp) const;
  /// A combined shape gives its parts a finer dp, not below `finest`.
  virtual std::vector<Chain> outline_of_part(int dim, double dp, double finest) const;
  virtual FacePatches patches(double dp) const;
  /// A shape may rotate the lattice.
  virtual Point from_lattice(const Point& x) const;
  virtual Point to_lattice(const Point& x) const;
  virtual Bounds lattice_bounds() const;
};

/// Copies share the shape.
class Shape {
 public:
  template <std::derived_from<ShapeBase> S>
  Shape(S shape)
      : base_(std::make_shared<const S>(std::move(shape))),
        copy_([](const ShapeBase& of) -> std::shared_ptr<ShapeBase> {
          return std::make_shared<S>(static_cast<const S&>(of));
        }) {}

  const ShapeBase* operator->() const { return base_.get(); }
  /// Returns nullptr if the shape is not an S.
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
