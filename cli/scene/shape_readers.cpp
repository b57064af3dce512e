#include "cli/scene/shape_readers.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "engine/scene/shapes/ellipse.hpp"
#include "engine/scene/shapes/implicit.hpp"
#include "engine/scene/shapes/polygon.hpp"

namespace taut::cli {
namespace {

using Kind = TomlValue::Kind;

constexpr std::size_t most_points = 10000;

bool is_list(const TomlValue& value) { return value.kind == Kind::array; }

Point read_corner(TomlCursor& shape, const TomlValue& value, std::string_view key) {
  if (!is_list(value) || value.items.size() != 2)
    shape.fail(value, key,
               fmt::format("a point must be an array of two numbers, [x, y] in m, not {}",
                           is_list(value) ? fmt::format("an array of {}", value.items.size())
                                          : std::string(value.kind_name())));
  return {shape.value_of(value.items[0], key), shape.value_of(value.items[1], key), 0};
}

/// Merges consecutive equal points.
Chain read_contour(TomlCursor& shape, const TomlValue& value, std::string_view key) {
  if (!is_list(value)) shape.fail(value, key, "a contour must be an array of points, [[x, y], ...]");
  Chain contour;
  for (const TomlValue& item : value.items) {
    const Point x = read_corner(shape, item, key);
    if (contour.empty() || x != contour.back()) contour.push_back(x);
  }
  if (contour.size() > 1 && contour.back() == contour.front()) contour.pop_back();
  if (contour.size() < 3)
    shape.fail(value, key,
               fmt::format("a contour must have at least three points, but this one has {}; "
                           "the last point is joined to the first",
                           contour.size()));
  return contour;
}

std::vector<Chain> read_contours(TomlCursor& shape) {
  const TomlValue *points = shape.find("points"), *contours = shape.find("contours");
  if (points && contours)
    shape.fail(*contours, "contours",
               "contours and points are both given; a polygon must have only one of them");
  if (!contours) return {read_contour(shape, shape.need("points"), "points")};
  if (!is_list(*contours) || contours->items.empty())
    shape.fail(*contours, "contours", "contours must be an array of contours, each an array of points");
  std::vector<Chain> result;
  for (const TomlValue& item : contours->items) result.push_back(read_contour(shape, item, "contours"));
  return result;
}

}  // namespace

Shape read_polygon(TomlCursor& shape, const ShapeSetting&) {
  const std::vector<Chain> contours = read_contours(shape);
  const std::string_view key = shape.find("points") ? "points" : "contours";
  const TomlValue& value = shape.need(key);
  std::size_t points = 0;
  for (const Chain& contour : contours) points += contour.size();
  if (points > most_points)
    shape.fail(
        value, key,
        fmt::format(
            "the polygon has {} points; at most {} are allowed. Use a shape of type mask or svg instead",
            points, most_points));
  std::optional<Point> centre;
  if (shape.find("centre")) centre = shape.point("centre", 2);
  if (const auto place = crossing(contours)) {
    const Point from = centre.value_or(Point{});
    shape.fail(value, key,
               fmt::format("two sides of the polygon cross, or lie on each other, at ({:.6g}, {:.6g}) m; "
                           "the contours of a polygon must not cross themselves or each other",
                           (*place)[0] + from[0], (*place)[1] + from[1]));
  }
  Polygon polygon(contours, centre);
  if (!(polygon.measure(2) > 0))
    shape.fail(value, key, "the polygon has no area: its points lie on a line; it must enclose an area");
  return polygon;
}

Shape read_ellipse(TomlCursor& shape, const ShapeSetting& setting) {
  return Ellipse{shape.point("centre", setting.dim), shape.point("semi_axes", setting.dim)};
}

Shape read_expression(TomlCursor& shape, const ShapeSetting& setting) {
  Implicit result(read_low_and_high(shape, setting.dim), {});
  const TomlValue& inside = shape.need("inside");
  result.inside = shape.function_of(inside, "inside");
  if (!result.inside)
    shape.fail(inside, "inside",
               "inside is 0, so the shape is empty; give an expression that is not 0 inside the shape");
  return result;
}

}  // namespace taut::cli
