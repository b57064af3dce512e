#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/core.h>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/fields.hpp"
#include "engine/diagnostics/measure_kinds.hpp"

namespace taut::cli {
namespace {

std::string known_probe(TomlCursor& cursor, const TomlValue& value, std::string_view key,
                        const Scene& scene) {
  const std::string name = cursor.text_of(value, key);
  if (index_of(scene.probes, name) == scene.probes.size())
    cursor.fail_unknown(value, key, "probe", name, names_of(scene.probes));
  return name;
}

void read_probe_of(TomlCursor& cursor, const Scene& scene, Measure& measure) {
  measure.probes = {known_probe(cursor, cursor.need("probe"), "probe", scene)};
}

void read_probes_of(TomlCursor& cursor, const Scene& scene, Measure& measure) {
  const auto dim = static_cast<std::size_t>(scene.dim);
  const TomlValue& value = cursor.need("probes");
  if (value.kind != TomlValue::Kind::array || value.items.size() != dim)
    cursor.fail(value, "probes",
                fmt::format("probes must be an array of {} names of probes: the {} components of one point",
                            dim, dim == 2 ? "x and y" : "x, y and z"));
  for (const TomlValue& item : value.items)
    measure.probes.push_back(known_probe(cursor, item, "probes", scene));
}

void read_line_of(TomlCursor& cursor, const Scene& scene, Measure& measure) {
  measure.line = cursor.text("line");
  if (index_of(scene.lines, measure.line) == scene.lines.size())
    cursor.fail_unknown(cursor.need("line"), "line", "line", measure.line, names_of(scene.lines));
}

void read_body_of(TomlCursor& cursor, const Scene& scene, Measure& measure) {
  measure.body = body_index(cursor, cursor.need("body"), "body", scene);
}

void read_fields_of(TomlCursor& cursor, const Scene& scene, Measure& measure) {
  const TomlValue& value = cursor.need("fields");
  if (value.kind != TomlValue::Kind::array || value.items.empty() ||
      value.items.size() > static_cast<std::size_t>(scene.dim))
    cursor.fail(
        value, "fields",
        fmt::format("fields must be an array of 1 to {} names of fields: the components of one vector",
                    scene.dim));
  for (const TomlValue& item : value.items) {
    measure.fields.push_back(cursor.text_of(item, "fields"));
    if (!find_field(measure.fields.back(), scene.dim))
      cursor.fail_unknown(item, "fields", "field", measure.fields.back(), names_of_fields(scene.dim));
  }
}

void read_rigid_motion(TomlCursor& cursor, const Scene& scene, Measure& measure) {
  measure.rigid_motion_free = cursor.choice("rigid_motion") == "free";
  std::vector<std::string> displacement{"displacement_x", "displacement_y"};
  if (scene.dim == 3) displacement.emplace_back("displacement_z");
  if (measure.rigid_motion_free && measure.fields != displacement)
    cursor.fail(cursor.need("rigid_motion"), "rigid_motion",
                fmt::format(R"(rigid_motion = "free" needs fields = ["{}"]; use "counts" for other fields)",
                            join(displacement, R"(", ")")));
}

void read_axis(TomlCursor& cursor, const Scene& scene, Measure& measure) {
  measure.axis = turning_axis(cursor, scene);
}

void read_threshold(TomlCursor& cursor, const Scene&, Measure& measure) {
  measure.threshold = cursor.number("threshold");
}

void read_scale(TomlCursor& cursor, const Scene&, Measure& measure) {
  measure.scale = cursor.number("scale");
  // an expression may be 0 for some parameters
  if (measure.scale == 0 && cursor.need("scale").kind != TomlValue::Kind::text)
    cursor.fail(cursor.need("scale"), "scale",
                "scale is 0; it must not be 0, because the result is divided by it");
}

void read_band(TomlCursor& cursor, const Scene&, Measure& measure) {
  const std::vector<double> ends = cursor.numbers("band", 2);
  if (!(ends[0] < ends[1]))
    cursor.fail(cursor.need("band"), "band",
                fmt::format("band = [{}, {}] must be two frequencies in Hz, the lower one first",
                            exact(ends[0]), exact(ends[1])));
  measure.band = {ends[0], ends[1]};
}

void read_from(TomlCursor& cursor, const Scene&, Measure& measure) { measure.from = cursor.number("from"); }

void read_until(TomlCursor& cursor, const Scene&, Measure& measure) {
  const TomlValue* given = cursor.find("until");
  if (given == nullptr) return;
  measure.until = cursor.number("until");
  if (!(*measure.until > measure.from))
    cursor.fail(
        *given, "until",
        fmt::format("until = {} s must be after from = {} s", exact(*measure.until), exact(measure.from)));
}

void read_about(TomlCursor& cursor, const Scene&, Measure& measure) {
  const TomlValue* given = cursor.find("about");
  measure.about_mean = given != nullptr && given->kind == TomlValue::Kind::text && given->text == "mean";
  if (!measure.about_mean) measure.about = cursor.number("about");
}

void read_time(TomlCursor& cursor, const Scene&, Measure& measure) { measure.time = cursor.number("time"); }

void read_free(TomlCursor& cursor, const Scene& scene, Measure& measure) {
  if (!cursor.text("free", "").empty())
    measure.free = known_probe(cursor, cursor.need("free"), "free", scene);
}

struct MeasureKey : KeyInfo {
  void (*read)(TomlCursor&, const Scene&, Measure&);
};
/// Read first: `numbers` may use material constants of the measured body.
constexpr std::array objects = {
    MeasureKey{{"probe", types::text("name of a probe"), "", "probe that gives the series"}, read_probe_of},
    MeasureKey{{"probes", types::text("PROBE").list(2, 3), "",
                "probes of the components of one point: x and y, in 3D also z"},
               read_probes_of},
    MeasureKey{{"line", types::text("name of a line"), "", "line with the field"}, read_line_of},
    MeasureKey{{"body", types::text("name of a body"), "", "body that is measured"}, read_body_of},
    MeasureKey{{"fields", types::one_of("FIELD", names_of_fields).list(1, 3), "",
                "fields to compare: the components of one vector"},
               read_fields_of},
    MeasureKey{{"rigid_motion", types::word("counts", "free"), "counts",
                "free: subtracts the nearest small rigid motion from the error, "
                "for displacements of a body whose loads do not fix it; counts: includes it"},
               read_rigid_motion},
};
constexpr std::array numbers = {
    MeasureKey{{"axis", types::vector_of(3, "[x, y, z]"), "[0, 0, 1]",
                "axis of rotation through the origin; only in 3D"},
               read_axis},
    MeasureKey{{"threshold", types::number(), "0", "threshold, in the unit of the series, or of `free`"},
               read_threshold},
    MeasureKey{{"scale", types::number(), "1",
                "divisor of the result, not 0. "
                "With the range of the reference, rmse is a relative error with unit \"1\""},
               read_scale},
    MeasureKey{{"band", types::vector_of(2, "[low, high]", "Hz", at_least(0)), "",
                "range in which the frequency is searched, the lower end first"},
               read_band},
    MeasureKey{{"from", types::number("s", at_least(0)), "0", "start of the evaluated part of the series"},
               read_from},
    MeasureKey{{"until", types::number("s", above(0)), "the end of the run",
                "end of the evaluated part of the series, after `from`"},
               read_until},
    MeasureKey{{"about", types::number().or_other("mean"), "0",
                "level of the oscillation, in the unit of the series; mean: the mean over whole periods"},
               read_about},
    MeasureKey{{"time", types::number("s", at_least(0)), "", "time of the value"}, read_time},
    MeasureKey{{"free", types::text("name of a probe"), "none",
                "probe that is above the threshold when the bodies are apart"},
               read_free},
};

void read_keys(std::span<const MeasureKey> keys, const MeasureKind& kind, TomlCursor& cursor,
               const Scene& scene, Measure& measure) {
  for (const std::string_view taken : kind.keys) {
    const auto key = std::ranges::find(keys, taken, &MeasureKey::name);
    if (key != keys.end()) key->read(cursor, scene, measure);
  }
}

const Body& measured_body(const Measure& measure, const Scene& scene) {
  int body = measure.body;
  if (!measure.line.empty()) body = scene.lines[index_of(scene.lines, measure.line)].body;
  if (!measure.probes.empty())
    body = scene.probes[index_of(scene.probes, measure.probes.front())].bodies.front();
  return scene.bodies[static_cast<std::size_t>(body)];
}

const KeyInfo& measure_key(std::string_view name) {
  const auto* key = std::ranges::find(objects, name, &MeasureKey::name);
  if (key != objects.end()) return *key;
  key = std::ranges::find(numbers, name, &MeasureKey::name);
  if (key == numbers.end())
    throw std::logic_error(fmt::format("the key '{}' of measures has no reader", name));
  return *key;
}

Measure read_measure(TomlCursor& cursor, const Scene& scene) {
  Measure measure;
  measure.name = label(cursor, names_of(scene.measures));
  measure.kind = cursor.choice("of", names_of(measure_kinds()));
  const MeasureKind& kind = *find_measure_kind(measure.kind);
  cursor.also_takes(keys_of_measure(kind));
  read_keys(objects, kind, cursor, scene, measure);
  measure.unit = cursor.line("unit", "");
  const int material = measured_body(measure, scene).material;
  add_names(cursor.names(), scene.materials[static_cast<std::size_t>(material)]);
  read_keys(numbers, kind, cursor, scene, measure);
  cursor.finish();
  return measure;
}

}  // namespace

std::vector<KeyInfo> keys_of_measure(const MeasureKind& kind) {
  std::vector<KeyInfo> keys;
  for (const std::string_view key : kind.keys) keys.push_back(measure_key(key));
  return keys;
}

void read_measures(TomlCursor& root, Scene& scene) {
  read_each(root, "measure",
            [&](TomlCursor& cursor) { scene.measures.push_back(read_measure(cursor, scene)); });
}

}  // namespace taut::cli
