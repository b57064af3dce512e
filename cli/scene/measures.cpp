#include <algorithm>
#include <array>
#include <set>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/fields.hpp"

namespace taut::cli {
namespace {

const std::vector<std::string> axis_names = {"x", "y", "z"};

/// What a probe of a kind has to say.
struct ProbeKind {
  std::string_view name;
  Probe::Kind kind;
  int bodies;
  bool at, to, axis;
};
constexpr std::array probe_kinds{
    ProbeKind{"displacement", Probe::Kind::displacement, 1, true, false, true},
    ProbeKind{"position", Probe::Kind::position, 1, true, false, true},
    ProbeKind{"distance", Probe::Kind::distance, 1, true, true, false},
    ProbeKind{"mean_velocity", Probe::Kind::mean_velocity, 1, false, false, true},
    ProbeKind{"gap", Probe::Kind::gap, 2, false, false, false},
    ProbeKind{"mirror_asymmetry", Probe::Kind::mirror_asymmetry, 2, false, false, true},
};

/// What a measure of a kind may say besides name, probe and unit.
struct MeasureKind {
  std::string_view name;
  Measure::Kind kind;
  bool threshold, scale, free;
  std::size_t probes = 1;
  bool line = false, fields = false;  // what is measured in the place of probes
};
constexpr std::array measure_kinds{
    MeasureKind{"period", Measure::Kind::period, false, false, false},
    MeasureKind{"first_peak", Measure::Kind::first_peak, false, false, false},
    MeasureKind{"decay", Measure::Kind::decay, false, false, false},
    MeasureKind{"rmse", Measure::Kind::rmse, false, false, false},
    MeasureKind{"minimum", Measure::Kind::minimum, false, false, false},
    MeasureKind{"maximum", Measure::Kind::maximum, false, false, false},
    MeasureKind{"first_below", Measure::Kind::first_below, true, false, false},
    MeasureKind{"last_below", Measure::Kind::last_below, true, false, false},
    MeasureKind{"final_ratio", Measure::Kind::final_ratio, true, true, true},
    MeasureKind{"path_error", Measure::Kind::path_error, false, true, false, 2},
    MeasureKind{"frequency", Measure::Kind::frequency, false, false, false},
    MeasureKind{"turn", Measure::Kind::turn, false, false, false, 2},
    MeasureKind{"line_rmse", Measure::Kind::line_rmse, false, false, false, 0, true},
    MeasureKind{"at_rest", Measure::Kind::at_rest, false, false, false},
    MeasureKind{"field_rmse", Measure::Kind::field_rmse, false, false, false, 0, false, true},
    MeasureKind{"field_error", Measure::Kind::field_error, false, false, false, 0, false, true},
};

std::vector<int> probe_bodies(TomlCursor& cursor, int number, const Scene& scene) {
  if (number == 1) return {body_index(cursor, cursor.need("body"), "body", scene)};
  const TomlValue& pair = cursor.need("bodies");
  if (pair.kind != TomlValue::Kind::array || pair.items.size() != 2)
    cursor.fail(pair, "bodies", "bodies must be an array of two names of bodies");
  std::vector<int> bodies;
  for (const TomlValue& item : pair.items) bodies.push_back(body_index(cursor, item, "bodies", scene));
  if (bodies[0] == bodies[1]) cursor.fail(pair, "bodies", "bodies must be two different ones");
  return bodies;
}

Probe read_probe(TomlCursor& cursor, const Scene& scene) {
  Probe probe;
  probe.name = label(cursor, names_of(scene.probes));
  const ProbeKind& kind = probe_kinds[index_of(probe_kinds, cursor.choice("of", names_of(probe_kinds)))];
  probe.kind = kind.kind;
  probe.bodies = probe_bodies(cursor, kind.bodies, scene);
  const int material = scene.bodies[static_cast<std::size_t>(probe.bodies.front())].material;
  add_names(cursor.names(), scene.materials[static_cast<std::size_t>(material)]);
  if (kind.at) probe.at = cursor.point("at", scene.dim);
  if (kind.to) probe.to = cursor.point("to", scene.dim);
  if (kind.axis) {
    const std::vector<std::string> allowed(axis_names.begin(), axis_names.begin() + scene.dim);
    const auto axis = std::find(allowed.begin(), allowed.end(), cursor.choice("component", allowed));
    probe.axis = static_cast<int>(axis - allowed.begin());
  }
  cursor.finish();
  return probe;
}

std::string known_probe(TomlCursor& cursor, const TomlValue& value, std::string_view key,
                        const Scene& scene) {
  const std::string name = cursor.text_of(value, key);
  if (index_of(scene.probes, name) == scene.probes.size())
    cursor.fail_unknown(value, key, "probe", name, names_of(scene.probes));
  return name;
}

std::string known_line(TomlCursor& cursor, const Scene& scene) {
  const std::string name = cursor.text("line");
  if (index_of(scene.lines, name) == scene.lines.size())
    cursor.fail_unknown(cursor.need("line"), "line", "line", name, names_of(scene.lines));
  return name;
}

/// `fields = ["displacement_x", "displacement_y"]`
std::vector<std::string> known_fields(TomlCursor& cursor, int dim) {
  const TomlValue& value = cursor.need("fields");
  if (value.kind != TomlValue::Kind::array || value.items.empty() ||
      value.items.size() > static_cast<std::size_t>(dim))
    cursor.fail(value, "fields",
                "fields must be an array of 1 to " + std::to_string(dim) +
                    " names of fields: the components of a vector");
  std::vector<std::string> fields;
  for (const TomlValue& item : value.items) {
    fields.push_back(cursor.text_of(item, "fields"));
    if (!find_field(fields.back()))
      cursor.fail_unknown(item, "fields", "field", fields.back(), names_of_fields());
  }
  return fields;
}

/// Only a displacement has a rigid motion.
bool is_rigid_motion_free(TomlCursor& cursor, const Measure& measure) {
  if (!cursor.find("rigid_motion")) cursor.table().set("rigid_motion", TomlValue(std::string("counts")));
  if (cursor.choice("rigid_motion", {"counts", "free"}) == "counts") return false;
  if (measure.fields != std::vector<std::string>{"displacement_x", "displacement_y"})
    cursor.fail(cursor.need("rigid_motion"), "rigid_motion",
                "rigid_motion is free in fields = [\"displacement_x\", \"displacement_y\"] only");
  return true;
}

/// The body that a measure looks at first.
const Body& measured_body(const Measure& measure, const Scene& scene) {
  int body = measure.body;
  if (!measure.line.empty()) body = scene.lines[index_of(scene.lines, measure.line)].body;
  if (!measure.probes.empty())
    body = scene.probes[index_of(scene.probes, measure.probes.front())].bodies.front();
  return scene.bodies[static_cast<std::size_t>(body)];
}

/// `probe = "name"`, or `probes = ["x", "y"]` of a measure that takes several.
std::vector<std::string> measured_probes(TomlCursor& cursor, const MeasureKind& kind, const Scene& scene) {
  if (kind.probes == 1) return {known_probe(cursor, cursor.need("probe"), "probe", scene)};
  const TomlValue& value = cursor.need("probes");
  if (value.kind != TomlValue::Kind::array || value.items.size() != kind.probes)
    cursor.fail(value, "probes",
                "probes must be an array of " + std::to_string(kind.probes) +
                    " names of probes: those of x and y of a point");
  std::vector<std::string> probes;
  for (const TomlValue& item : value.items) probes.push_back(known_probe(cursor, item, "probes", scene));
  return probes;
}

/// Where a frequency is looked for, and from when on.
void read_band(TomlCursor& cursor, Measure& measure) {
  const std::vector<double> ends = cursor.numbers("band", 2);
  if (!(ends[0] >= 0 && ends[0] < ends[1]))
    cursor.fail(cursor.need("band"), "band",
                "band = [" + exact(ends[0]) + ", " + exact(ends[1]) +
                    "] must be two frequencies in Hz, the lower one first");
  measure.band = {ends[0], ends[1]};
  measure.from = cursor.number("from", measure.from);
  if (!(measure.from >= 0))
    cursor.fail(cursor.need("from"), "from", "from = " + exact(measure.from) + " s must be at least 0");
}

Measure read_measure(TomlCursor& cursor, const Scene& scene) {
  Measure measure;
  measure.name = label(cursor, names_of(scene.measures));
  const MeasureKind& kind =
      measure_kinds[index_of(measure_kinds, cursor.choice("of", names_of(measure_kinds)))];
  measure.kind = kind.kind;
  if (kind.probes > 0) measure.probes = measured_probes(cursor, kind, scene);
  if (kind.line) measure.line = known_line(cursor, scene);
  if (kind.fields) {
    measure.body = body_index(cursor, cursor.need("body"), "body", scene);
    measure.fields = known_fields(cursor, scene.dim);
    measure.rigid_motion_free = is_rigid_motion_free(cursor, measure);
  }
  measure.unit = cursor.text("unit", "");
  const int material = measured_body(measure, scene).material;
  add_names(cursor.names(), scene.materials[static_cast<std::size_t>(material)]);
  if (kind.threshold) measure.threshold = cursor.number("threshold", measure.threshold);
  if (kind.scale) {
    measure.scale = cursor.number("scale", measure.scale);
    if (measure.scale == 0)
      cursor.fail(cursor.need("scale"), "scale", "scale is 0; the ratio to it would be infinite");
  }
  if (kind.kind == Measure::Kind::frequency) read_band(cursor, measure);
  if (kind.free && !cursor.text("free", "").empty())
    measure.free = known_probe(cursor, cursor.need("free"), "free", scene);
  cursor.finish();
  return measure;
}

}  // namespace

int body_index(TomlCursor& cursor, const TomlValue& value, std::string_view key, const Scene& scene) {
  const std::string name = cursor.text_of(value, key);
  const std::size_t i = index_of(scene.bodies, name);
  if (i == scene.bodies.size()) cursor.fail_unknown(value, key, "body", name, names_of(scene.bodies));
  return static_cast<int>(i);
}

void read_probes(TomlCursor& root, Scene& scene) {
  read_each(root, "probe", [&](TomlCursor& cursor) { scene.probes.push_back(read_probe(cursor, scene)); });
}

void read_measures(TomlCursor& root, Scene& scene) {
  read_each(root, "measure",
            [&](TomlCursor& cursor) { scene.measures.push_back(read_measure(cursor, scene)); });
  std::set<std::string> used;
  for (const Measure& measure : scene.measures) {
    used.insert(measure.free);
    used.insert(measure.probes.begin(), measure.probes.end());
  }
  for (TomlValue& value : root.list("probe")) {
    const TomlEntry& name = *value.find("name");
    if (!used.contains(name.value.text))
      root.fail(name.value, "probe." + name.value.text,
                "the probe '" + name.value.text +
                    "' is unused: no [[measure]] follows it; remove it or measure it");
  }
}

}  // namespace taut::cli
