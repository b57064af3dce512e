#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/point.hpp"

namespace taut {

// What a shape says of itself; a new one is a struct with these members, which `AnyShape` holds:
//
//   bounds()                  the least box around it
//   holds(x, dim, tolerance)  x lies inside, or at most `tolerance` outside
//   measure(dim)              area or volume, m^dim
//   thinnest(dim)             the extent that the spacing divides into whole particles, m; 0: none
//   middle()                  what it is reflected about
//   anchor()                  a corner of the lattice of a body that it is the first shape of
//   shift(axis, by)           moves it
//   from_lattice(x), to_lattice(x), lattice_bounds()
//                             of one that turns that lattice: where a place of it is, the way back, and the box
//                             around the shape that lies along it; `anchor` is of the lattice then
//   sites(dim, dp)            of one that lays its own particles where it is a whole body: these; none where
//                             the lattice does it
//   outline(dim, dp)          its faces: closed chains of points exactly on them, about dp apart, with the solid
//                             to the left of the way from one to the next; corners are points. None in 3D
//   patches(dp)               the same in 3D of one that lays its own particles there, else none
//
// A shape that follows its own faces with layers of particles keeps its strain smooth up to them: steps of a
// lattice at a curved face leave a noise of the strain there that does not fall with the spacing.
//
// Lengths are in m; components beyond `dim` say nothing.

struct Bounds {
  Point low{}, high{};

  Point middle() const {
    return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])};
  }
};

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

/// The place of a particle at t = 0 and its volume, m^dim.
struct InitialSite {
  Point x{};
  double V0 = 0;
  int turned = -1;  // the site that this one comes to when all are turned onto each other, -1: they cannot be
  double inside = 1;              // the part of its cell that is inside the body
  std::array<bool, 3> on_face{};  // across this axis, as the body is laid
  Point middle{};                 // where x is but for jitter, as the body is placed: regions are told by it
};

/// How a round body is laid. Methods that keep the neighbours of the start take the layers that fit its faces
/// best; those that search for neighbours, with one smoothing length for all directions, want particles that
/// are equally far from each other in all.
enum class RoundLayout : std::uint8_t {
  aligned,  // in layers with the same number of particles on each, of what is hollow only
  spaced,   // in layers whose particles are about a spacing apart on each
  lattice,  // cut from the square lattice
};
std::string_view name(RoundLayout);

/// A cuboid in 3D.
struct Box {
  Point low{}, high{};

  /// Along an axis, about dp wide, where particles stand on the faces.
  long cells(std::size_t axis, double dp) const {
    return std::max(1L, std::lround((high[axis] - low[axis]) / dp));
  }

  Bounds bounds() const { return {low, high}; }
  bool holds(const Point& x, int dim, double tolerance) const {
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
      if (x[k] < low[k] - tolerance || x[k] > high[k] + tolerance) return false;
    return true;
  }
  double measure(int dim) const {
    double product = 1;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
      product *= std::max(0.0, high[k] - low[k]);
    return product;
  }
  double thinnest(int dim) const {
    double least = high[0] - low[0];
    for (std::size_t k = 1; k < static_cast<std::size_t>(dim); ++k) least = std::min(least, high[k] - low[k]);
    return least;
  }
  Point middle() const { return bounds().middle(); }
  Point anchor() const { return low; }
  void shift(std::size_t axis, double by) {
    low[axis] += by;
    high[axis] += by;
  }
  std::vector<Chain> outline(int dim, double dp) const;
  bool operator==(const Box&) const = default;
};

/// π r², or the volume of a ball.
inline double measure_of_ball(int dim, double r) {
  return dim == 2 ? std::numbers::pi * r * r : 4.0 / 3.0 * std::numbers::pi * r * r * r;
}

inline Bounds bounds_of_ball(const Point& centre, double r) {
  return {{centre[0] - r, centre[1] - r, centre[2] - r}, {centre[0] + r, centre[1] + r, centre[2] + r}};
}

inline double distance_between(const Point& a, const Point& b, int dim) {
  double squared = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k) squared += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(squared);
}

/// A ball in 3D.
struct Disc {
  Point centre{};
  double radius = 0;
  RoundLayout layout = RoundLayout::lattice;

  Bounds bounds() const { return bounds_of_ball(centre, radius); }
  bool holds(const Point& x, int dim, double tolerance) const {
    return distance_between(x, centre, dim) <= radius + tolerance;
  }
  double measure(int dim) const { return measure_of_ball(dim, radius); }
  double thinnest(int) const { return 2 * radius; }
  Point middle() const { return centre; }
  Point anchor() const { return bounds().middle(); }
  void shift(std::size_t axis, double by) { centre[axis] += by; }
  /// One particle in the centre and 6, 12, 18 … on the layers around it: a hexagonal lattice made round,
  /// which it is to the eye within each of six sectors.
  std::vector<InitialSite> sites(int dim, double dp) const;
  std::vector<Chain> outline(int dim, double dp) const;
  bool operator==(const Disc&) const = default;
};

/// A hollow ball in 3D.
struct Ring {
  Point centre{};
  double inner = 0, outer = 0;
  RoundLayout layout = RoundLayout::spaced;

  Bounds bounds() const { return bounds_of_ball(centre, outer); }
  bool holds(const Point& x, int dim, double tolerance) const {
    const double r = distance_between(x, centre, dim);
    return r >= inner - tolerance && r <= outer + tolerance;
  }
  double measure(int dim) const { return measure_of_ball(dim, outer) - measure_of_ball(dim, inner); }
  double thinnest(int) const { return outer - inner; }
  Point middle() const { return centre; }
  Point anchor() const { return bounds().middle(); }
  void shift(std::size_t axis, double by) { centre[axis] += by; }
  /// Concentric layers at r = inner + (k + ½) dp, the first particle of each on the positive x axis. Aligned:
  /// on each as many as are a spacing apart in the middle of the ring, so that each has its neighbours where
  /// a lattice has them, on a grid of polar coordinates. Spaced: a whole number about dp apart on each, which
  /// puts the neighbours of the next layer anywhere. In 3D aligned only: on each layer the six faces of a cube
  /// made round, with n × n particles each, whose mean volume is dp³.
  std::vector<InitialSite> sites(int dim, double dp) const;
  /// One point for each particle of the innermost and of the outermost layer, at its angle.
  std::vector<Chain> outline(int dim, double dp) const;
  FacePatches patches(double dp) const;
  bool operator==(const Ring&) const = default;
};

/// A round bar from one point to another, hollow where `inner` is above 0; 3D only.
struct Cylinder {
  Point from{}, to{};
  double radius = 0, inner = 0;
  RoundLayout layout = RoundLayout::lattice;

  Bounds bounds() const;
  bool holds(const Point& x, int dim, double tolerance) const;
  double length() const { return distance_between(from, to, 3); }
  double measure(int) const { return (measure_of_ball(2, radius) - measure_of_ball(2, inner)) * length(); }
  double thinnest(int) const { return std::min(length(), inner > 0 ? radius - inner : 2 * radius); }
  Point middle() const { return Bounds{from, to}.middle(); }
  Point anchor() const { return from; }
  void shift(std::size_t axis, double by) {
    from[axis] += by;
    to[axis] += by;
  }
  /// Of a hollow one that is aligned: slices, about dp apart, of what a ring has in 2D.
  std::vector<InitialSite> sites(int dim, double dp) const;
  FacePatches patches(double dp) const;
  bool operator==(const Cylinder&) const = default;
};

/// Any other shape, of a type that only those who make it know. It never changes: copies share it.
class AnyShape {
 public:
  template <class S>
  static AnyShape of(S shape) {
    return AnyShape(std::make_shared<const Held<S>>(std::move(shape)));
  }

  Bounds bounds() const { return held_->bounds(); }
  bool holds(const Point& x, int dim, double tolerance) const { return held_->holds(x, dim, tolerance); }
  double measure(int dim) const { return held_->measure(dim); }
  double thinnest(int dim) const { return held_->thinnest(dim); }
  Point middle() const { return held_->middle(); }
  Point anchor() const { return held_->anchor(); }
  void shift(std::size_t axis, double by) { held_ = held_->shifted(axis, by); }
  std::vector<InitialSite> sites(int dim, double dp) const { return held_->sites(dim, dp); }
  std::vector<Chain> outline(int dim, double dp) const { return held_->outline(dim, dp); }
  FacePatches patches(double dp) const { return held_->patches(dp); }
  Point from_lattice(const Point& x) const { return held_->from_lattice(x); }
  Point to_lattice(const Point& x) const { return held_->to_lattice(x); }
  Bounds lattice_bounds() const { return held_->lattice_bounds(); }

  /// nullptr if it is of another type.
  template <class S>
  const S* as() const {
    const auto* held = dynamic_cast<const Held<S>*>(held_.get());
    return held ? &held->shape : nullptr;
  }
  bool operator==(const AnyShape&) const = default;

 private:
  struct Members {
    virtual ~Members() = default;
    virtual Bounds bounds() const = 0;
    virtual bool holds(const Point& x, int dim, double tolerance) const = 0;
    virtual double measure(int dim) const = 0;
    virtual double thinnest(int dim) const = 0;
    virtual Point middle() const = 0;
    virtual Point anchor() const = 0;
    virtual std::shared_ptr<const Members> shifted(std::size_t axis, double by) const = 0;
    virtual std::vector<InitialSite> sites(int dim, double dp) const = 0;
    virtual std::vector<Chain> outline(int dim, double dp) const = 0;
    virtual FacePatches patches(double dp) const = 0;
    virtual Point from_lattice(const Point& x) const = 0;
    virtual Point to_lattice(const Point& x) const = 0;
    virtual Bounds lattice_bounds() const = 0;
  };

  template <class S>
  struct Held final : Members {
    explicit Held(S of) : shape(std::move(of)) {}

    Bounds bounds() const override { return shape.bounds(); }
    bool holds(const Point& x, int dim, double tolerance) const override {
      return shape.holds(x, dim, tolerance);
    }
    double measure(int dim) const override { return shape.measure(dim); }
    double thinnest(int dim) const override { return shape.thinnest(dim); }
    Point middle() const override { return shape.middle(); }
    Point anchor() const override { return shape.anchor(); }
    std::shared_ptr<const Members> shifted(std::size_t axis, double by) const override {
      S moved = shape;
      moved.shift(axis, by);
      return std::make_shared<const Held>(std::move(moved));
    }
    std::vector<InitialSite> sites([[maybe_unused]] int dim, [[maybe_unused]] double dp) const override {
      if constexpr (requires { shape.sites(dim, dp); }) return shape.sites(dim, dp);
      return {};
    }
    std::vector<Chain> outline(int dim, double dp) const override { return shape.outline(dim, dp); }
    FacePatches patches([[maybe_unused]] double dp) const override {
      if constexpr (requires { shape.patches(dp); }) return shape.patches(dp);
      return {};
    }
    Point from_lattice(const Point& x) const override {
      if constexpr (requires { shape.from_lattice(x); }) return shape.from_lattice(x);
      return x;
    }
    Point to_lattice(const Point& x) const override {
      if constexpr (requires { shape.to_lattice(x); }) return shape.to_lattice(x);
      return x;
    }
    Bounds lattice_bounds() const override {
      if constexpr (requires { shape.lattice_bounds(); }) return shape.lattice_bounds();
      return shape.bounds();
    }

    S shape;
  };

  explicit AnyShape(std::shared_ptr<const Members> held) : held_(std::move(held)) {}

  std::shared_ptr<const Members> held_;
};

using Shape = std::variant<Box, Disc, Ring, Cylinder, AnyShape>;

}  // namespace taut
