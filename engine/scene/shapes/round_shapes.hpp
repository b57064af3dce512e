#pragma once

#include <cstdint>
#include <string_view>

#include "engine/scene/shape.hpp"

namespace taut {

enum class RoundLayout : std::uint8_t {
  aligned,  // equal numbers of particles in all layers; only for hollow shapes
  spaced,   // particles about dp apart in each layer
  lattice,
};
std::string_view name(RoundLayout);

/// Whether distances along the inner face are at least a third of those along the outer face.
bool can_be_aligned(double inner, double outer);

double measure_of_ball(int dim, double r);

struct Disc final : ShapeBase {
  Point centre{};
  double radius = 0;
  RoundLayout layout = RoundLayout::lattice;

  Disc(const Point& centre, double radius, RoundLayout layout = RoundLayout::lattice)
      : centre(centre), radius(radius), layout(layout) {}

  /// Default in 2D.
  static RoundLayout default_layout(bool keeps_neighbors);

  Bounds bounds() const override;
  bool holds(const Point& x, int dim, double tolerance) const override;
  void shift(std::size_t axis, double by) override { centre[axis] += by; }
  double measure(int dim) const override { return measure_of_ball(dim, radius); }
  double extent_to_divide(int) const override { return 2 * radius; }
  Point middle() const override { return centre; }
  Point anchor() const override { return bounds().middle(); }
  /// Places 1 particle in the centre and 6, 12, 18 … on the layers.
  std::vector<InitialSite> sites(int dim, double dp) const override;
  std::vector<Chain> outline(int dim, double dp) const override;
  bool operator==(const Disc&) const = default;
};

struct Ring final : ShapeBase {
  Point centre{};
  double inner = 0, outer = 0;
  RoundLayout layout = RoundLayout::spaced;

  Ring(const Point& centre, double inner, double outer, RoundLayout layout = RoundLayout::spaced)
      : centre(centre), inner(inner), outer(outer), layout(layout) {}

  RoundLayout default_layout(int dim, bool keeps_neighbors) const;

  Bounds bounds() const override;
  bool holds(const Point& x, int dim, double tolerance) const override;
  void shift(std::size_t axis, double by) override { centre[axis] += by; }
  double measure(int dim) const override { return measure_of_ball(dim, outer) - measure_of_ball(dim, inner); }
  double extent_to_divide(int) const override { return outer - inner; }
  Point middle() const override { return centre; }
  Point anchor() const override { return bounds().middle(); }
  /// In 2D, aligned layers form a polar grid with particles about dp apart at the mean radius.
  std::vector<InitialSite> sites(int dim, double dp) const override;
  std::vector<Chain> outline(int dim, double dp) const override;
  FacePatches patches(double dp) const override;
  bool operator==(const Ring&) const = default;
};

/// Hollow if `inner` > 0; 3D only.
struct Cylinder final : ShapeBase {
  Point from{}, to{};
  double radius = 0, inner = 0;
  RoundLayout layout = RoundLayout::lattice;

  Cylinder(const Point& from, const Point& to, double radius, double inner = 0,
           RoundLayout layout = RoundLayout::lattice)
      : from(from), to(to), radius(radius), inner(inner), layout(layout) {}

  RoundLayout default_layout(bool keeps_neighbors) const;
  double length() const { return distance_between(from, to, 3); }

  Bounds bounds() const override;
  bool holds(const Point& x, int dim, double tolerance) const override;
  void shift(std::size_t axis, double by) override { from[axis] += by, to[axis] += by; }
  double measure(int dim) const override;
  double extent_to_divide(int dim) const override;
  Point middle() const override { return Bounds{from, to}.middle(); }
  Point anchor() const override { return from; }
  /// Slices about dp apart, each a 2D ring.
  std::vector<InitialSite> sites(int dim, double dp) const override;
  FacePatches patches(double dp) const override;
  bool operator==(const Cylinder&) const = default;
};

}  // namespace taut
