#include "engine/layout/layers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "engine/error.hpp"
#include "engine/scene/shapes/round_shapes.hpp"
#include "engine/scene/shapes/turned.hpp"

namespace taut {
namespace {

// thicknesses as in Disc::sites, Ring::sites and Cylinder::sites

double part_of(double extent, double spacing) {
  return extent / static_cast<double>(std::max(1L, std::lround(extent / spacing)));
}

double thickness_of(const Disc& disc, double spacing) {
  const long layers = std::max(0L, std::lround(disc.radius / spacing - 0.5));
  return disc.radius / (static_cast<double>(layers) + 0.5);
}

bool is_in_end_slice(const Cylinder& pipe, const Point& x, double slice) {
  double from_middle = -0.5 * pipe.length();
  for (std::size_t k = 0; k < x.size(); ++k)
    from_middle += (x[k] - pipe.from[k]) * (pipe.to[k] - pipe.from[k]) / pipe.length();
  return std::abs(from_middle) > 0.5 * pipe.length() - slice;
}

Point moved(Point x, const Point& direction, double by) {
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += by * direction[k];
  return x;
}

/// Unit vectors.
std::vector<Point> lattice_axes(const Body& body, int dim) {
  const auto place = [&](const Point& x) { return placed(body, body.shapes.front()->from_lattice(x), dim); };
  std::vector<Point> axes;
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k) {
    Point end{};
    end[k] = 1;
    axes.push_back(moved(place(end), place({}), -1));
  }
  return axes;
}

/// Sum of the directions to places outside the body one layer away; 0 below the outermost layer.
Point outwards(const Point& x, const Body& body, int dim, double thickness) {
  Point sum{};
  for (const double a : {-1.0, 0.0, 1.0})
    for (const double b : {-1.0, 0.0, 1.0})
      for (const double c : {-1.0, 0.0, 1.0}) {
        const Point step{a, b, c};
        if ((dim == 3 || c == 0) && !holds(body, moved(x, step, thickness), dim, 0))
          sum = moved(sum, step, 1);
      }
  return sum;
}

/// Number of faces of the body over number of layers of the region along the line through x, at most 1.
double faces_per_layer(const Point& x, const Point& direction, const Expression& where, const Body& body,
                       int dim, double thickness) {
  constexpr int farthest = 3;
  const double apart = 1.01 * thickness;  // steps past the end of the region despite round-off
  int layers = 1, faces = 0;
  for (const double side : {-1.0, 1.0})
    for (int step = 1; step <= farthest; ++step, ++layers) {
      const Point next = moved(x, direction, side * step * apart);
      const bool inside = holds(body, next, dim, 0);
      faces += !inside;
      if (!inside || where(next) == 0) break;
    }
  return std::min(1.0, static_cast<double>(faces) / layers);
}

}  // namespace

double layer_thickness(const Body& body, const InitialParticles& initial, const std::vector<int>& id,
                       double spacing) {
  if (body.shapes.size() != 1 || !body.without.empty() || body.relaxed) return spacing;
  const int dim = initial.dim;
  const Shape whole = unplaced_body(body, dim).shapes.front();
  const Shape* shape = &whole;
  while (const auto* turned = shape->as<Turned>()) shape = &turned->shape;
  double thickness = spacing;
  if (const auto* disc = shape->as<Disc>(); disc && dim == 2 && disc->layout != RoundLayout::lattice)
    thickness = thickness_of(*disc, spacing);
  if (const auto* ring = shape->as<Ring>();
      ring && (dim == 2 ? ring->layout != RoundLayout::lattice : ring->layout == RoundLayout::aligned))
    thickness = part_of(ring->outer - ring->inner, spacing);
  if (const auto* pipe = shape->as<Cylinder>(); pipe && pipe->layout == RoundLayout::aligned) {
    const double slice = part_of(pipe->length(), spacing);
    const bool at_ends = std::ranges::all_of(id, [&](int i) {
      return is_in_end_slice(*pipe, whole->to_lattice(unplaced_point(body, initial.cell(i), dim)), slice);
    });
    thickness = at_ends ? slice : part_of(pipe->radius - pipe->inner, spacing);
  }
  return std::abs(thickness - spacing) <= 1e-9 * spacing ? spacing : thickness;  // round-off
}

double layers_of_region(const Expression& where, const Body& body, const InitialParticles& initial,
                        const std::vector<int>& id, double thickness) {
  const int dim = initial.dim;
  const std::vector<Point> axes = lattice_axes(body, dim);
  double faces = 0;
  for (const int i : id) {
    const Point &x = initial.cell(i), out = outwards(x, body, dim, thickness);
    double most = 0;
    for (const Point& axis : axes)
      most = std::max(most, faces_per_layer(x, axis, where, body, dim, thickness));
    if (const double length = distance_between(out, {}, 3); length > 0)
      most = std::max(most, faces_per_layer(x, moved({}, out, 1 / length), where, body, dim, thickness));
    faces += most;
  }
  return faces > 0 ? static_cast<double>(id.size()) / faces : std::numeric_limits<double>::infinity();
}

void refuse_deep_traction(const Load& load, const Body& body, double layers) {
  constexpr double deep = 1.4;
  if (layers < deep) return;
  throw SceneError(
      fmt::format("body.{}.loaded", body.name),
      fmt::format("loaded[{}]: the region of a traction on body '{}' {}. "
                  "A traction acts on the outermost layer of particles or element cells: "
                  "end its 'where' one spacing below the face, such as x > 0.04 - dp for the face x = 0.04, "
                  "or give a force_density",
                  &load - body.loads.data(), body.name,
                  std::isinf(layers) ? "lies inside the body" : "is more than one layer deep"));
}

void refuse_edge(const Body& body) {
  throw SceneError(
      fmt::format("body.{}.loaded", body.name),
      fmt::format(
          "a traction of body '{}' is on two faces that meet at an edge: write one entry of 'loaded' for each face",
          body.name));
}

}  // namespace taut
