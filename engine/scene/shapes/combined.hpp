#pragma once

#include <algorithm>

#include "engine/scene/contours.hpp"

namespace taut {

struct Combined final : ShapeBase {
  Combination how{};
  std::vector<Shape> shapes;

  Combined(Combination how, std::vector<Shape> shapes) : how(how), shapes(std::move(shapes)) {}

  Bounds bounds() const override {
    Bounds box = shapes.front()->bounds();
    if (how == Combination::difference) return box;
    for (std::size_t s = 1; s < shapes.size(); ++s) {
      const Bounds other = shapes[s]->bounds();
      if (how == Combination::together) {
        box = joined(box, other);
        continue;
      }
      for (std::size_t k = 0; k < box.low.size(); ++k) {
        box.low[k] = std::max(box.low[k], other.low[k]);
        box.high[k] = std::max(box.low[k], std::min(box.high[k], other.high[k]));
      }
    }
    return box;
  }
  bool holds(const Point& x, int dim, double tolerance) const override {
    const auto holds_it = [&](const Shape& shape) { return shape->holds(x, dim, tolerance); };
    switch (how) {
      case Combination::together:
        return std::ranges::any_of(shapes, holds_it);
      case Combination::common:
        return std::ranges::all_of(shapes, holds_it);
      case Combination::difference:
        break;
    }
    return holds_it(shapes.front()) &&
           std::none_of(shapes.begin() + 1, shapes.end(),
                        [&](const Shape& shape) { return shape->holds(x, dim, -tolerance); });
  }
  double measure(int dim) const override {
    double measure = shapes.front()->measure(dim);
    if (how == Combination::difference) return measure;
    for (std::size_t k = 1; k < shapes.size(); ++k) {
      const double other = shapes[k]->measure(dim);
      measure = how == Combination::together ? measure + other : std::min(measure, other);
    }
    return measure;
  }
  bool has_exact_measure() const override { return false; }
  double extent_to_divide(int dim) const override { return shapes.front()->extent_to_divide(dim); }
  Point middle() const override { return shapes.front()->middle(); }
  Point anchor() const override { return shapes.front()->anchor(); }
  void shift(std::size_t axis, double by) override {
    for (Shape& shape : shapes) shape.shift(axis, by);
  }
  std::vector<Chain> outline(int dim, double dp) const override {
    return outline_of_part(dim, dp, finely * finely * dp);
  }
  std::vector<Chain> outline_of_part(int dim, double dp, double finest) const override {
    if (dim != 2) return {};
    const double fine = std::max(finely * dp, finest);
    std::vector<std::vector<Chain>> solids;
    for (const Shape& shape : shapes) solids.push_back(shape->outline_of_part(dim, fine, finest));
    return evenly_spaced(combined(how, solids, dp), dp);
  }
  Point from_lattice(const Point& x) const override { return shapes.front()->from_lattice(x); }
  Point to_lattice(const Point& x) const override { return shapes.front()->to_lattice(x); }
  Bounds lattice_bounds() const override {
    return how == Combination::together
               ? bounds_of_placed(bounds(), [&](const Point& x) { return to_lattice(x); })
               : shapes.front()->lattice_bounds();
  }

 private:
  static constexpr double finely = 0.125;
};

}  // namespace taut
