#pragma once

#include "engine/scene/scene.hpp"

namespace taut {

struct Turned final : ShapeBase {
  Shape shape;
  Rotation rotation;

  Turned(Shape shape, const Rotation& rotation) : shape(std::move(shape)), rotation(rotation) {}

  Bounds bounds() const override {
    return bounds_of_placed(shape->bounds(), [&](const Point& x) { return rotated(rotation, x); });
  }
  bool holds(const Point& x, int dim, double tolerance) const override {
    return shape->holds(back(x), dim, tolerance);
  }
  double measure(int dim) const override { return shape->measure(dim); }
  bool has_exact_measure() const override { return shape->has_exact_measure(); }
  double extent_to_divide(int dim) const override { return shape->extent_to_divide(dim); }
  Point middle() const override { return rotated(rotation, shape->middle()); }
  Point anchor() const override { return shape->anchor(); }
  void shift(std::size_t axis, double by) override {
    shape.shift(axis, by);
    rotation.about[axis] += by;
  }
  std::vector<InitialSite> sites(int dim, double dp) const override {
    std::vector<InitialSite> sites = shape->sites(dim, dp);
    for (InitialSite& site : sites) site.x = rotated(rotation, site.x);
    return sites;
  }
  std::vector<Chain> outline(int dim, double dp) const override { return turned(shape->outline(dim, dp)); }
  std::vector<Chain> outline_of_part(int dim, double dp, double finest) const override {
    return turned(shape->outline_of_part(dim, dp, finest));
  }
  FacePatches patches(double dp) const override {
    FacePatches faces = shape->patches(dp);
    for (Point& x : faces.node) x = rotated(rotation, x);
    return faces;
  }
  Point from_lattice(const Point& x) const override { return rotated(rotation, shape->from_lattice(x)); }
  Point to_lattice(const Point& x) const override { return shape->to_lattice(back(x)); }
  Bounds lattice_bounds() const override { return shape->lattice_bounds(); }

 private:
  std::vector<Chain> turned(std::vector<Chain> chains) const {
    for (Chain& chain : chains)
      for (Point& x : chain) x = rotated(rotation, x);
    return chains;
  }
  Point back(const Point& x) const { return rotated({rotation.axis, rotation.about, -rotation.angle}, x); }
};

}  // namespace taut
