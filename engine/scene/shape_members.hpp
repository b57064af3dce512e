#pragma once

#include <variant>
#include <vector>

#include "engine/scene/shapes.hpp"

namespace taut {

// The members of whatever shape it is; what a shape has not is nothing, or leaves a place as it is.

inline Bounds bounds_of(const Shape& shape) {
  return std::visit([](const auto& s) { return s.bounds(); }, shape);
}

inline bool holds(const Shape& shape, const Point& x, int dim, double tolerance) {
  return std::visit([&](const auto& s) { return s.holds(x, dim, tolerance); }, shape);
}

inline double measure_of(const Shape& shape, int dim) {
  return std::visit([&](const auto& s) { return s.measure(dim); }, shape);
}

inline double thinnest_of(const Shape& shape, int dim) {
  return std::visit([&](const auto& s) { return s.thinnest(dim); }, shape);
}

inline Point middle_of(const Shape& shape) {
  return std::visit([](const auto& s) { return s.middle(); }, shape);
}

inline Point anchor_of(const Shape& shape) {
  return std::visit([](const auto& s) { return s.anchor(); }, shape);
}

inline void shift(Shape& shape, std::size_t axis, double by) {
  std::visit([&](auto& s) { s.shift(axis, by); }, shape);
}

inline std::vector<InitialSite> sites_of(const Shape& shape, int dim, double dp) {
  const auto lay = [&]([[maybe_unused]] const auto& s) -> std::vector<InitialSite> {
    if constexpr (requires { s.sites(dim, dp); }) return s.sites(dim, dp);
    return {};
  };
  return std::visit(lay, shape);
}

inline std::vector<Chain> outline_of(const Shape& shape, int dim, double dp) {
  const auto lay = [&]([[maybe_unused]] const auto& s) -> std::vector<Chain> {
    if constexpr (requires { s.outline(dim, dp); }) return s.outline(dim, dp);
    return {};
  };
  return std::visit(lay, shape);
}

inline FacePatches patches_of(const Shape& shape, double dp) {
  const auto lay = [&]([[maybe_unused]] const auto& s) -> FacePatches {
    if constexpr (requires { s.patches(dp); }) return s.patches(dp);
    return {};
  };
  return std::visit(lay, shape);
}

inline Point from_lattice(const Shape& shape, const Point& x) {
  const auto* other = std::get_if<AnyShape>(&shape);
  return other ? other->from_lattice(x) : x;
}

inline Point to_lattice(const Shape& shape, const Point& x) {
  const auto* other = std::get_if<AnyShape>(&shape);
  return other ? other->to_lattice(x) : x;
}

inline Bounds lattice_bounds_of(const Shape& shape) {
  const auto* other = std::get_if<AnyShape>(&shape);
  return other ? other->lattice_bounds() : bounds_of(shape);
}

/// The least box around both.
inline Bounds joined(Bounds a, const Bounds& b) {
  for (std::size_t k = 0; k < a.low.size(); ++k)
    a.low[k] = std::min(a.low[k], b.low[k]), a.high[k] = std::max(a.high[k], b.high[k]);
  return a;
}

/// The least box around where `place` puts the corners of another.
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

}  // namespace taut
