#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/fields.hpp"

namespace taut::cli {
namespace {

namespace key {
constexpr KeyInfo body{"body", types::text("name of a body"), "", "observed body"};
constexpr KeyInfo bodies{"bodies", types::text("BODY").list(2, 2), "", "the two observed bodies"};
constexpr KeyInfo images{"bodies", types::text("BODY").list(2, 2), "or body",
                         "two bodies that should be mirror images of each other"};
constexpr KeyInfo own_image{"body", types::text("name of a body"), "or bodies",
                            "one body that should be its own mirror image"};
constexpr KeyInfo at{"at", types::vector("[x, y]", "m"), "",
                     "material point, given by its position in the initial configuration"};
constexpr KeyInfo to{"to", types::vector("[x, y]", "m"), "", "second material point, given in the same way"};
constexpr KeyInfo component{
    "component", types::word("x", "y", "z"), "",
    "axis of the component; in mirror_asymmetry the normal of the mirror plane, which contains the origin"};
constexpr KeyInfo part{"component", types::word("xx", "yy", "zz", "xy", "xz", "yz", "von_mises", "pressure"),
                       "", "component or invariant of the stress; xz and yz only in 3D"};
constexpr KeyInfo reaction_where{"where", types::expression("expression of the place"), "everywhere",
                                 "region of the summed particles, where the expression is not 0"};
constexpr KeyInfo met{"bodies", types::text("BODY").list(2, 2), "or body and wall",
                      "force of the second body on the first"};
constexpr KeyInfo met_body{"body", types::text("name of a body"), "or bodies", "body on which the wall acts"};
constexpr KeyInfo wall{"wall", types::text("name of a wall"), "or bodies", "wall that acts on `body`"};
constexpr KeyInfo value{"value", types::expression("expression"), "",
                        "expression of t and of the probes above it, such as \"2*gap + tip\""};
constexpr KeyInfo axis{"axis", types::vector_of(3, "[x, y, z]"), "[0, 0, 1]",
                       "axis of rotation through the origin; only in 3D"};
}  // namespace key

// clang-format off
const std::vector<ProbeKind> kinds{
    {"displacement", "m", "displacement of a material point", {key::body, key::at, key::component}},
    {"position", "m", "position of a material point", {key::body, key::at, key::component}},
    {"velocity", "m/s", "velocity of a material point", {key::body, key::at, key::component}},
    {"distance", "m", "distance between two material points", {key::body, key::at, key::to}},
    {"mean_velocity", "m/s", "velocity of the centre of mass", {key::body, key::component}},
    {"mean_position", "m", "position of the centre of mass", {key::body, key::component}},
    {"greatest_position", "m", "largest coordinate of a particle of the body", {key::body, key::component}},
    {"gap", "m",
     "smallest distance between the surfaces of two bodies, below 0 where they overlap. "
     "It is at most the search range of the contact, one or two spacings",
     {key::bodies}},
    {"mirror_asymmetry", "m",
     "largest deviation of a body from the mirror image of another body, or of itself, every 32 steps",
     {key::images, key::own_image, key::component}},
    {"turn", "rad",
     "angle by which a material point has turned about the axis since the start, whole turns included",
     {key::body, key::at, key::axis}},
    {"stress", "Pa",
     "Cauchy stress at a material point, as in the fields: positive in tension, pressure positive in compression",
     {key::body, key::at, key::part}},
    {"reaction", ProbeKind::force_unit,
     "sum of the reaction forces on clamped and driven particles of a body. Without loads and damping, "
     "only reaction, contact force and weight change the momentum of the body",
     {key::body, key::reaction_where, key::component}},
    {"contact_force", ProbeKind::force_unit,
     "contact force of another body or of a wall on a body",
     {key::met, key::met_body, key::wall, key::component}},
    {"expression", "unit of value", "expression of other probes", {key::value}},
};
// clang-format on

std::vector<int> probe_bodies(TomlCursor& cursor, const ProbeKind& kind, const Scene& scene) {
  const bool two = kind.takes("bodies");
  if (!two || (kind.takes("body") && cursor.find("body"))) {
    const int body = body_index(cursor, cursor.need("body"), "body", scene);
    return std::vector<int>(two ? 2 : 1, body);
  }
  const TomlValue& pair = cursor.need("bodies");
  if (pair.kind != TomlValue::Kind::array || pair.items.size() != 2)
    cursor.fail(pair, "bodies", "bodies must be an array of two names of bodies");
  std::vector<int> bodies;
  for (const TomlValue& item : pair.items) bodies.push_back(body_index(cursor, item, "bodies", scene));
  if (bodies[0] == bodies[1]) cursor.fail(pair, "bodies", "bodies must name two different bodies");
  return bodies;
}

void refuse_point_on_axis(TomlCursor& cursor, const Probe& probe) {
  const Point &a = probe.turns_about, &x = probe.at;
  const double along = a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
  double away = 0, size = 0;  // squared distances from axis and origin, m²
  for (std::size_t k = 0; k < 3; ++k) {
    away += (x[k] - along * a[k]) * (x[k] - along * a[k]);
    size += x[k] * x[k];
  }
  constexpr double round_off = 1e-24;
  if (!(away > round_off * size))
    cursor.fail(cursor.need("at"), "at",
                "at lies on the axis of rotation, where the angle is undefined; choose a point off the axis");
}

StressPart stress_part(TomlCursor& cursor, int dim) {
  constexpr std::array parts = {std::pair{"xx", StressPart::xx},
                                std::pair{"yy", StressPart::yy},
                                std::pair{"zz", StressPart::zz},
                                std::pair{"xy", StressPart::xy},
                                std::pair{"von_mises", StressPart::von_mises},
                                std::pair{"pressure", StressPart::pressure},
                                std::pair{"xz", StressPart::xz},
                                std::pair{"yz", StressPart::yz}};
  constexpr std::size_t in_2d = 6;
  std::vector<std::string> allowed;
  for (std::size_t k = 0; k < (dim == 2 ? in_2d : parts.size()); ++k) allowed.emplace_back(parts[k].first);
  const std::string given = cursor.choice("component", allowed);
  return std::ranges::find(parts, given, [](const auto& part) { return std::string(part.first); })->second;
}

int wall_index(TomlCursor& cursor, const Scene& scene) {
  const std::string name = cursor.text("wall");
  const std::size_t wall = index_of(scene.walls, name);
  if (wall == scene.walls.size())
    cursor.fail_unknown(cursor.need("wall"), "wall", "wall", name, names_of(scene.walls));
  return static_cast<int>(wall);
}

/// Takes bodies from the first probe in `value`. Defines material constants only if unique.
void read_probes_in(TomlCursor& cursor, const Scene& scene, Probe& probe) {
  const TomlValue& value = cursor.need("value");
  const std::set<std::string> used = names_in(value.kind == TomlValue::Kind::text ? value.text : "0");
  probe.of_forces = !used.contains("t");
  std::set<int> materials;
  const auto add_material = [&](int body) {
    materials.insert(scene.bodies[static_cast<std::size_t>(body)].material);
  };
  for (const Probe& other : scene.probes) {
    if (!used.contains(other.name)) continue;
    std::ranges::for_each(other.bodies, add_material);
    if (probe.bodies.empty()) probe.bodies = other.bodies;
    probe.of_forces = probe.of_forces && is_step_mean(other);
  }
  probe.of_forces = probe.of_forces && !probe.bodies.empty();
  if (probe.bodies.empty()) probe.bodies = {0};
  if (materials.empty())
    for (const Body& body : scene.bodies) materials.insert(body.material);
  if (materials.size() == 1)
    add_names(cursor.names(), scene.materials[static_cast<std::size_t>(*materials.begin())]);
  probe.value = cursor.function_of_probes(value, "value", names_of(scene.probes));
}

int axis_of_component(TomlCursor& cursor, const Scene& scene) {
  const std::vector<std::string> allowed(axis_names.begin(), axis_names.begin() + scene.dim);
  const auto axis = std::find(allowed.begin(), allowed.end(), cursor.choice("component", allowed));
  return static_cast<int>(axis - allowed.begin());
}

Probe read_probe(TomlCursor& cursor, const Scene& scene) {
  Probe probe;
  probe.name = label(cursor, names_of(scene.probes));
  const ProbeKind& kind = kinds[index_of(kinds, cursor.choice("of", names_of(kinds)))];
  cursor.also_takes(kind.keys);
  probe.kind = kind.kind();
  if (probe.kind == Probe::Kind::expression) {
    read_probes_in(cursor, scene, probe);
    cursor.finish();
    return probe;
  }
  probe.bodies = probe_bodies(cursor, kind, scene);
  const int material = scene.bodies[static_cast<std::size_t>(probe.bodies.front())].material;
  add_names(cursor.names(), scene.materials[static_cast<std::size_t>(material)]);
  if (kind.takes("at")) probe.at = cursor.point("at", scene.dim);
  if (kind.takes("to")) probe.to = cursor.point("to", scene.dim);
  if (probe.kind == Probe::Kind::stress)
    probe.part = stress_part(cursor, scene.dim);
  else if (kind.takes("component"))
    probe.axis = axis_of_component(cursor, scene);
  if (kind.takes("wall") && cursor.find("body")) probe.wall = wall_index(cursor, scene);
  if (const TomlValue* where = kind.takes("where") ? cursor.find("where") : nullptr) {
    probe.where = cursor.function_of(*where, "where");
    if (!probe.where)
      cursor.fail(*where, "where", "where is 0, so the region is empty; leave it out for the whole body");
  }
  if (kind.takes("axis")) {
    probe.turns_about = turning_axis(cursor, scene);
    refuse_point_on_axis(cursor, probe);
  }
  cursor.finish();
  return probe;
}

std::vector<double> read_line_times(TomlCursor& cursor) {
  const TomlValue& value = cursor.need("times");
  if (value.kind != TomlValue::Kind::array || value.items.empty())
    cursor.fail(value, "times", "times must be an array of one or more times in s, in increasing order");
  std::vector<double> times;
  for (const TomlValue& item : value.items) {
    const double time = cursor.value_of(item, "times"), before = times.empty() ? 0 : times.back();
    if (times.empty() ? time < 0 : time <= before)
      cursor.fail(
          item, "times",
          fmt::format("{} comes after {}; times must increase, from 0 on", exact(time), exact(before)));
    times.push_back(time);
  }
  return times;
}

SampleLine read_line(TomlCursor& cursor, const Scene& scene) {
  SampleLine line;
  line.name = label(cursor, names_of(scene.lines));
  line.body = body_index(cursor, cursor.need("body"), "body", scene);
  line.field = cursor.text("field");
  if (!find_field(line.field, scene.dim))
    cursor.fail_unknown(cursor.need("field"), "field", "field", line.field, names_of_fields(scene.dim));
  line.from = cursor.point("from", scene.dim);
  line.to = cursor.point("to", scene.dim);
  line.points = cursor.whole("points");
  line.times = read_line_times(cursor);
  line.in_space = cursor.choice("frame") == "space";
  cursor.finish();
  return line;
}

}  // namespace

bool ProbeKind::takes(std::string_view key) const {
  return std::ranges::find(keys, key, &KeyInfo::name) != keys.end();
}

std::span<const ProbeKind> probe_kinds() { return kinds; }

std::string_view unit_of(const Probe& probe, int dim) {
  if (probe.kind.is_force) return dim == 2 ? "N/m" : "N";
  if (probe.kind == Probe::Kind::expression) return "";
  return kinds[index_of(kinds, probe.kind.name)].unit;
}

Point turning_axis(TomlCursor& cursor, const Scene& scene) {
  if (scene.dim == 2) return {0, 0, 1};
  if (!cursor.find("axis")) {
    TomlValue z;
    z.kind = TomlValue::Kind::array;
    z.items = {TomlValue(0.0), TomlValue(0.0), TomlValue(1.0)};
    cursor.table().set("axis", z);
  }
  Point axis = cursor.point("axis", scene.dim);
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  if (!(length > 0))
    cursor.fail(cursor.need("axis"), "axis",
                "axis = [0, 0, 0] has no direction; give a vector such as [0, 0, 1]");
  for (double& component : axis) component /= length;
  return axis;
}

int body_index(TomlCursor& cursor, const TomlValue& value, std::string_view key, const Scene& scene) {
  const std::string name = cursor.text_of(value, key);
  const std::size_t i = index_of(scene.bodies, name);
  if (i == scene.bodies.size()) cursor.fail_unknown(value, key, "body", name, names_of(scene.bodies));
  return static_cast<int>(i);
}

void read_probes(TomlCursor& root, Scene& scene) {
  read_each(root, "probe", [&](TomlCursor& cursor) { scene.probes.push_back(read_probe(cursor, scene)); });
}

void read_lines(TomlCursor& root, Scene& scene) {
  read_each(root, "line", [&](TomlCursor& cursor) { scene.lines.push_back(read_line(cursor, scene)); });
}

}  // namespace taut::cli
