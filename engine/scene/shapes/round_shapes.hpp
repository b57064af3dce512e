#pragma once

#include <cstdint>
#include <string_view>

#include "engine/scene/shape.hpp"

namespace taut {

/// How a round body is laid. Methods that keep the neighbours of the start take the layers that fit its faces
/// best; those that search for neighbours, with one smoothing length for all directions, want particles that
/// are equally far from each other in all.
enum class RoundLayout : std::uint8_t {
  aligned,  // in layers with the same number of particles on each, of what is hollow only
  spaced,   // in layers whose particles are about a spacing apart on each
  lattice,  // cut from the square lattice
};
std::string_view name(RoundLayout);

/// The hole is large enough for aligned layers: particles on the inner face are at least a third as far apart as on
/// the outer one.
bool can_be_aligned(double inner, double outer);

/// π r², or the volume of a ball.
double measure_of_ball(int dim, double r);

/// A ball in 3D.
struct Disc final : ShapeBase {
  Point centre{};
  double radius = 0;
  RoundLayout layout = RoundLayout::lattice;

  Disc(const Point& centre, double radius, RoundLayout layout = RoundLayout::lattice)
      : centre(centre), radius(radius), layout(layout) {}

  /// The default for a method that keeps the initial neighbours, or for one that searches for neighbours; 2D.
  static RoundLayout default_layout(bool keeps_neighbors);

  Bounds bounds() const override;
  bool holds(const Point& x, int dim, double tolerance) const override;
  void shift(std::size_t axis, double by) override { centre[axis] += by; }
  double measure(int dim) const override { return measure_of_ball(dim, radius); }
  double thinnest(int) const override { return 2 * radius; }
  Point middle() const override { return centre; }
  Point anchor() const override { return bounds().middle(); }
  /// One particle in the centre and 6, 12, 18 … on the layers around it: a hexagonal lattice made round,
  /// which it is to the eye within each of six sectors.
  std::vector<InitialSite> sites(int dim, double dp) const override;
  std::vector<Chain> outline(int dim, double dp) const override;
  bool operator==(const Disc&) const = default;
};

/// A hollow ball in 3D.
struct Ring final : ShapeBase {
  Point centre{};
  double inner = 0, outer = 0;
  RoundLayout layout = RoundLayout::spaced;

  Ring(const Point& centre, double inner, double outer, RoundLayout layout = RoundLayout::spaced)
      : centre(centre), inner(inner), outer(outer), layout(layout) {}

  /// As for a disc.
  RoundLayout default_layout(int dim, bool keeps_neighbors) const;

  Bounds bounds() const override;
  bool holds(const Point& x, int dim, double tolerance) const override;
  void shift(std::size_t axis, double by) override { centre[axis] += by; }
  double measure(int dim) const override { return measure_of_ball(dim, outer) - measure_of_ball(dim, inner); }
  double thinnest(int) const override { return outer - inner; }
  Point middle() const override { return centre; }
  Point anchor() const override { return bounds().middle(); }
  /// Concentric layers at r = inner + (k + ½) dp, the first particle of each on the positive x axis. Aligned:
  /// on each as many as are a spacing apart in the middle of the ring, so that each has its neighbours where
  /// a lattice has them, on a grid of polar coordinates. Spaced: a whole number about dp apart on each, which
  /// puts the neighbours of the next layer anywhere. In 3D aligned only: on each layer the six faces of a cube
  /// made round, with n × n particles each, whose mean volume is dp³.
  std::vector<InitialSite> sites(int dim, double dp) const override;
  /// One point for each particle of the innermost and of the outermost layer, at its angle.
  std::vector<Chain> outline(int dim, double dp) const override;
  FacePatches patches(double dp) const override;
  bool operator==(const Ring&) const = default;
};

/// A round bar from one point to another, hollow where `inner` is above 0; 3D only.
struct Cylinder final : ShapeBase {
  Point from{}, to{};
  double radius = 0, inner = 0;
  RoundLayout layout = RoundLayout::lattice;

  Cylinder(const Point& from, const Point& to, double radius, double inner = 0,
           RoundLayout layout = RoundLayout::lattice)
      : from(from), to(to), radius(radius), inner(inner), layout(layout) {}

  /// As for a ring, if hollow.
  RoundLayout default_layout(bool keeps_neighbors) const;
  double length() const { return distance_between(from, to, 3); }

  Bounds bounds() const override;
  bool holds(const Point& x, int dim, double tolerance) const override;
  void shift(std::size_t axis, double by) override { from[axis] += by, to[axis] += by; }
  double measure(int dim) const override;
  double thinnest(int dim) const override;
  Point middle() const override { return Bounds{from, to}.middle(); }
  Point anchor() const override { return from; }
  /// Of a hollow one that is aligned: slices, about dp apart, of what a ring has in 2D.
  std::vector<InitialSite> sites(int dim, double dp) const override;
  FacePatches patches(double dp) const override;
  bool operator==(const Cylinder&) const = default;
};

}  // namespace taut
