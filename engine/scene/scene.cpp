#include "engine/scene/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace taut {
namespace {

bool any_is_given(const std::array<Expression, 3>& components) {
  return std::ranges::any_of(components, [](const Expression& component) { return component != nullptr; });
}

std::pair<double, double> cosine_and_sine(double degrees) {
  constexpr double quarter = 90, whole = 4;
  const double quarters = degrees / quarter, over = quarters - whole * std::floor(quarters / whole);
  constexpr std::array<std::pair<double, double>, 4> of_quarters = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  if (over == std::floor(over) && over < whole) return of_quarters[static_cast<std::size_t>(over)];
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

Point rotated(const Rotation& rotation, const Point& x) {
  const auto [cosine, sine] = cosine_and_sine(rotation.angle);
  const Point &k = rotation.axis, &o = rotation.about;
  const Point d{x[0] - o[0], x[1] - o[1], x[2] - o[2]};
  const double along = (1 - cosine) * (k[0] * d[0] + k[1] * d[1] + k[2] * d[2]);
  const Point across{k[1] * d[2] - k[2] * d[1], k[2] * d[0] - k[0] * d[2], k[0] * d[1] - k[1] * d[0]};
  Point y{};
  for (std::size_t a = 0; a < y.size(); ++a)
    y[a] = o[a] + (cosine * d[a] + (sine * across[a] + along * k[a]));
  return y;
}

Body unplaced_body(Body body, int dim) {
  const Point middle = body.shapes.front()->middle();
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
    if (body.mirror[k])
      for (std::vector<Shape>* shapes : {&body.shapes, &body.without})
        for (Shape& shape : *shapes) shape.shift(k, -2 * middle[k]);
  body.mirror = {};
  body.rotation = {};
  return body;
}

Point placed(const Body& body, Point x, int dim) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
    if (body.mirror[k]) x[k] = -x[k];
  return body.rotation ? rotated(*body.rotation, x) : x;
}

Point unplaced_point(const Body& body, Point x, int dim) {
  if (body.rotation) x = rotated({body.rotation->axis, body.rotation->about, -body.rotation->angle}, x);
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
    if (body.mirror[k]) x[k] = -x[k];
  return x;
}

bool holds(const Body& body, const Point& x, int dim, double tolerance) {
  Point y = x;
  if (body.rotation) y = rotated({body.rotation->axis, body.rotation->about, -body.rotation->angle}, y);
  const Point middle = body.shapes.front()->middle();
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
    if (body.mirror[k]) y[k] = 2 * middle[k] - y[k];
  const auto any_holds = [&](const std::vector<Shape>& shapes, double by) {
    return std::ranges::any_of(shapes, [&](const Shape& shape) { return shape->holds(y, dim, by); });
  };
  return any_holds(body.shapes, tolerance) && !any_holds(body.without, -tolerance);
}

double Material::sound_speed() const { return std::sqrt(bulk_modulus() / density); }

bool ends_before_run(const Drive& drive, const Scene& scene) {
  return drive.until && !(scene.until > 0 && *drive.until >= scene.until);
}

bool has_drives(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [](const Body& body) { return !body.drives.empty(); });
}

bool has_guides(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [](const Body& body) { return any_is_given(body.guided); });
}

bool has_displacements(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [](const Body& body) { return any_is_given(body.displacement); });
}

bool is_undisplaced(const Body& body) { return !any_is_given(body.displacement); }

Point displaced(const Body& body, const Point& x) {
  Point y = x;
  for (std::size_t k = 0; k < y.size(); ++k)
    if (body.displacement[k]) y[k] += body.displacement[k](x);
  return y;
}

bool has_gravity(const Scene& scene) {
  return std::ranges::any_of(scene.gravity, [](const auto& component) { return component != nullptr; });
}

bool has_loads(const Scene& scene) {
  return has_gravity(scene) ||
         std::ranges::any_of(scene.bodies, [](const Body& body) { return !body.loads.empty(); });
}

std::string_view name(Load::Kind kind) {
  constexpr std::string_view names[] = {"force", "force_density", "traction"};
  return names[static_cast<int>(kind)];
}

std::string_view name(Lattice lattice) {
  constexpr std::string_view names[] = {"square", "hexagonal"};
  return names[static_cast<int>(lattice)];
}

double fitted_spacing(const Body& first, int dim, double spacing) {
  const double extent = first.shapes.front()->extent_to_divide(dim);
  if (!(extent > 0)) return spacing;
  const double row = first.lattice == Lattice::hexagonal ? hexagonal_row : 1;
  const double fitted = extent / (std::max(1.0, std::round(extent / (spacing * row))) * row);
  return std::abs(fitted - spacing) <= 1e-9 * spacing ? spacing : fitted;  // round-off
}

}  // namespace taut
