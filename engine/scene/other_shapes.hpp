#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/scene/contours.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

// What an AnyShape may hold; the members are those of every shape (shapes.hpp).

/// An ellipsoid in 3D. `holds` takes the distance to the surface to first order.
struct Ellipse {
  Point centre{}, semi_axes{1, 1, 1};

  Bounds bounds() const;
  bool holds(const Point& x, int dim, double tolerance) const;
  double measure(int dim) const;
  double thinnest(int dim) const;
  Point middle() const { return centre; }
  Point anchor() const { return centre; }
  void shift(std::size_t axis, double by) { centre[axis] += by; }
  std::vector<Chain> outline(int dim, double dp) const;
};

/// What lies within an odd number of closed contours, 2D; no two of their sides cross.
class Polygon {
 public:
  /// With a centre the points are from it; the polygon is turned and reflected about it, and its lattice lies
  /// symmetrically about it. Else that is the middle of its box, and the lattice begins at the lower corner.
  Polygon(std::vector<Chain> contours, const std::optional<Point>& centre = {});

  Bounds bounds() const;
  bool holds(const Point& x, int dim, double tolerance) const;
  double measure(int) const { return area_; }
  double thinnest(int) const { return 0; }
  Point middle() const { return about_centre_ ? from_ : bounds().middle(); }
  Point anchor() const { return about_centre_ ? from_ : bounds().low; }
  void shift(std::size_t axis, double by) { from_[axis] += by; }
  std::vector<Chain> outline(int dim, double dp) const;

 private:
  using Side = std::array<Point, 2>;

  std::size_t strip_of(double y) const;
  bool is_inside(const Point& x) const;

  std::vector<Chain> contours_;
  Point from_{};  // what their points are from
  bool about_centre_;
  Bounds box_;       // of the contours
  double area_ = 0;  // m²
  std::vector<std::vector<Side>>
      strips_;  // the sides that reach into each of equal strips of the box, from below
};

/// Where two sides of the contours cross or lie on each other; none if they do not.
std::optional<Point> crossing(const std::vector<Chain>& contours);

/// The places of a box at which an expression is not 0. Steps of its faces below a quarter of dp are not
/// seen. For a tolerance it looks as far to all sides.
struct Implicit {
  Box within;
  Expression inside;
  Point by{};  // it has been moved by, m

  Bounds bounds() const;
  bool holds(const Point& x, int dim, double tolerance) const;
  double measure(int dim) const { return within.measure(dim); }  // at most
  double thinnest(int) const { return 0; }
  Point middle() const { return bounds().middle(); }
  Point anchor() const { return bounds().low; }
  void shift(std::size_t axis, double along) { by[axis] += along; }
  std::vector<Chain> outline(int dim, double dp) const;
};

/// Turned about a point, and with it the lattice or the layers of a body that it is the first shape of.
struct Turned {
  Shape shape;
  Rotation rotation;

  Bounds bounds() const;
  bool holds(const Point& x, int dim, double tolerance) const;
  double measure(int dim) const;
  double thinnest(int dim) const;
  Point middle() const;
  Point anchor() const;
  void shift(std::size_t axis, double by);
  std::vector<InitialSite> sites(int dim, double dp) const;
  std::vector<Chain> outline(int dim, double dp) const;
  FacePatches patches(double dp) const;
  Point from_lattice(const Point& x) const;
  Point to_lattice(const Point& x) const;
  Bounds lattice_bounds() const;

 private:
  Point back(const Point& x) const;
};

/// What several shapes, at least one, make together; lattice and middle are those of the first.
struct Combined {
  Combination how{};
  std::vector<Shape> shapes;

  Bounds bounds() const;
  bool holds(const Point& x, int dim, double tolerance) const;
  double measure(int dim) const;  // at most
  double thinnest(int dim) const;
  Point middle() const;
  Point anchor() const;
  void shift(std::size_t axis, double by);
  std::vector<Chain> outline(int dim, double dp) const;
  Point from_lattice(const Point& x) const;
  Point to_lattice(const Point& x) const;
  Bounds lattice_bounds() const;
};

/// Particles that were given one by one. A place is held where the cell of one is, a square (cube) of its
/// volume. The faces are where the mean of the indicator of the particles, with a cubic spline of radius 2
/// dp, is ½: half a spacing outside the outermost ones.
class GivenParticles {
 public:
  GivenParticles(std::vector<Point> places, std::vector<double> volumes, int dim);

  Bounds bounds() const;
  bool holds(const Point& x, int dim, double tolerance) const;
  double measure(int) const { return volume_; }
  double thinnest(int) const { return 0; }
  Point middle() const { return bounds().middle(); }
  Point anchor() const { return bounds().low; }
  void shift(std::size_t axis, double by) { by_[axis] += by; }
  std::vector<InitialSite> sites(int dim, double dp) const;
  std::vector<Chain> outline(int dim, double dp) const;

 private:
  std::array<long, 3> cell_of(const Point& x) const;
  template <class Visit>
  void around(const Point& x, const Visit& visit) const;

  std::vector<Point> places_;
  std::vector<double> volumes_;
  Point by_{};         // they have been moved by, m
  Bounds box_;         // around their cells
  double volume_ = 0;  // of all
  double size_ = 0;    // of the greatest cell, m; and of the cells of the search
  std::vector<std::pair<std::array<long, 3>, int>> sorted_;  // by the cell of the search
};

/// Area or volume of a body of one shape, m^dim; none where the shape knows a bound only, and of several.
std::optional<double> exact_measure(const Body& body, int dim);

}  // namespace taut
