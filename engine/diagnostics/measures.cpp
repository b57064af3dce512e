#include "engine/diagnostics/measures.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/core.h>
#include <fmt/format.h>

#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

using Value = std::optional<double>;
using Samples = std::vector<std::vector<LineSample>>;

std::string names_of(const auto& items) {
  std::string names;
  for (const auto& item : items) names.append(names.empty() ? "" : ", ").append(item.name);
  return names;
}

const MeasureKind& kind_of(const Measure& measure) {
  if (const MeasureKind* kind = find_measure_kind(measure.kind)) return *kind;
  throw SceneError(fmt::format("measure.{}.of", measure.name),
                   fmt::format("there is no measure of kind '{}'; name one of: {}", measure.kind,
                               names_of(measure_kinds())));
}

std::size_t probe_index(const Scene& scene, const std::string& probe, const std::string& key) {
  const auto found = std::ranges::find(scene.probes, probe, &Probe::name);
  if (found != scene.probes.end()) return static_cast<std::size_t>(found - scene.probes.begin());
  throw SceneError(key,
                   fmt::format("there is no probe '{}'; name one of: {}", probe, names_of(scene.probes)));
}

template <class Map>
auto find_or_null(const Map& map, const std::string& key) -> const typename Map::mapped_type* {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &found->second;
}

void add_reference(MeasureSource& source, const Reference& reference) {
  const std::string& name = source.measure->name;
  source.reference.exact = find_or_null(reference.solution, name);
  const ReferenceTable* table = find_or_null(reference.table, name);
  if (table != nullptr && !table->t.empty())
    for (const std::vector<double>& column : table->value)
      source.reference.table.push_back({table->t, column});
  if (const double* value = find_or_null(reference.value, name)) source.reference_value = *value;
}

MeasureSource source_of(const Measure& measure, const Scene& scene, const Series& series,
                        const Samples& lines) {
  const std::string key = "measure." + measure.name;
  MeasureSource source;
  source.measure = &measure;
  for (const std::string& name : measure.probes) {
    const std::size_t probe = probe_index(scene, name, key + ".probe");
    const Probe& of = scene.probes[probe];
    source.curve.push_back(finite_part({series.time, series.value.at(probe), is_step_mean(of)}));
    if (of.kind == Probe::Kind::mirror_asymmetry) source.end_extreme_may_grow = false;
  }
  if (!measure.free.empty()) {
    source.free =
        finite_part({series.time, series.value.at(probe_index(scene, measure.free, key + ".free"))});
  }
  const auto line = std::ranges::find(scene.lines, measure.line, &SampleLine::name);
  const std::size_t l = static_cast<std::size_t>(line - scene.lines.begin());
  if (line != scene.lines.end()) source.line = &*line;
  if (l < lines.size()) source.samples = &lines[l];
  source.until = scene.until;
  return source;
}

Value error_of(const Value& value, const Value& reference) {
  if (!value || !reference) return std::nullopt;
  const double difference = std::abs(*value - *reference);
  return *reference == 0 ? difference : difference / std::abs(*reference);
}

}  // namespace

std::vector<MeasureResult> measure(const Scene& scene, const Series& series, std::string_view law,
                                   const Samples& lines, const Snapshot* now) {
  const Reference* reference = find_or_null(scene.references, std::string(law));
  std::vector<MeasureResult> results;
  for (const Measure& each : scene.measures) {
    const MeasureKind& kind = kind_of(each);
    MeasureResult result;
    result.name = each.name;
    result.kind = each.kind;
    result.unit = each.unit;
    MeasureSource source = source_of(each, scene, series, lines);
    source.now = now;
    if (reference) add_reference(source, *reference);
    const auto no_sample = [](const Curve& curve) { return curve.size() == 0; };
    const bool seen =
        std::ranges::none_of(source.curve, no_sample) && !(source.free && no_sample(*source.free));
    const Measured found = !seen             ? Measured("the series is not finite at its start")
                           : each.scale == 0 ? Measured("`scale` is 0 with these parameters")
                                             : kind.value(source);
    result.value = found.value;
    result.why = found.why;
    if (reference && found.why == no_reference)
      result.why =
          fmt::format("the reference '{}' of this law has no value for this measure", reference->name);
    for (std::size_t k = 0; k < source.curve.size() && seen && !found.value; ++k)
      if (const std::size_t kept = source.curve[k].size(); kept < series.time.size())
        result.why = fmt::format("{} is not finite at {:g} s", each.probes[k], series.time[kept]);
    if (reference) result.reference = kind.reference(source);
    if (result.reference) result.reference_name = reference->name_for(each.name);
    result.error = error_of(result.value, result.reference);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace taut
