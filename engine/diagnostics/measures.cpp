#include "engine/measures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/diagnostics/curve.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

using Value = std::optional<double>;

/// What a measure is made from.
struct Source {
  Curve curve;
  std::optional<Curve> free;              // final_ratio
  const ReferenceTable* table = nullptr;  // rmse
  double until = 0;                       // s
  bool turns = true;                      // an extreme at the end is not the last word
};

Value period(const Curve& curve) {
  const std::vector<HalfCycle> cycles = half_cycles(curve);
  return cycles.size() < 2 ? std::nullopt : Value(cycles[1].end);
}

Value first_peak(const Curve& curve) {
  const std::vector<HalfCycle> cycles = half_cycles(curve);
  return cycles.empty() ? std::nullopt : Value(cycles.front().peak);
}

Value decay(const Curve& curve) {
  const std::vector<HalfCycle> cycles = half_cycles(curve);
  if (cycles.size() < 3) return std::nullopt;
  const std::size_t periods = (cycles.size() - 1) / 2;  // between the first and the last peak of its side
  const double kept = cycles[2 * periods].peak / cycles.front().peak;
  return 1 - std::pow(kept, 1 / static_cast<double>(periods));
}

Value rmse(const Source& source) {
  if (source.table == nullptr || source.table->t.empty()) return std::nullopt;
  const Curve table = {source.table->t, source.table->value};
  const double begin = std::max(source.curve.t.front(), table.t.front());
  const double end = std::min(source.until, table.t.back());
  if (source.curve.t.back() < end || end <= begin) return std::nullopt;
  return rms_difference(source.curve, table, begin, end);
}

Value extreme(const Source& source, double value) {
  return source.turns && source.curve.y.back() == value ? std::nullopt : Value(value);
}

Value first_below(const Curve& curve, double threshold) {
  const auto found = std::ranges::find_if(curve.y, [=](double y) { return y <= threshold; });
  if (found == curve.y.end()) return std::nullopt;
  const auto k = static_cast<std::size_t>(found - curve.y.begin());
  return k == 0 ? curve.t.front() : crossing_time(curve, k, threshold);
}

Value last_below(const Curve& curve, double threshold) {
  std::size_t above = curve.size();  // the first sample of the last stretch above
  while (above > 0 && curve.y[above - 1] > threshold) --above;
  if (above == 0 || above == curve.size()) return std::nullopt;
  return crossing_time(curve, above, threshold);
}

Value final_ratio(const Source& source, double scale, double threshold) {
  if (source.free) {
    const auto& gap = source.free->y;
    const bool touched = std::ranges::any_of(gap, [&](double y) { return y <= threshold; });
    if (!touched || gap.back() <= threshold) return std::nullopt;
  }
  return source.curve.y.back() / scale;
}

Value value_of(const Measure& measure, const Source& source) {
  if (source.curve.size() == 0) return std::nullopt;
  switch (measure.kind) {
    case Measure::Kind::period:
      return period(source.curve);
    case Measure::Kind::first_peak:
      return first_peak(source.curve);
    case Measure::Kind::decay:
      return decay(source.curve);
    case Measure::Kind::rmse:
      return rmse(source);
    case Measure::Kind::minimum:
      return extreme(source, std::ranges::min(source.curve.y));
    case Measure::Kind::maximum:
      return extreme(source, std::ranges::max(source.curve.y));
    case Measure::Kind::first_below:
      return first_below(source.curve, measure.threshold);
    case Measure::Kind::last_below:
      return last_below(source.curve, measure.threshold);
    case Measure::Kind::final_ratio:
      return final_ratio(source, measure.scale, measure.threshold);
  }
  return std::nullopt;
}

std::size_t probe_index(const Scene& scene, const std::string& probe, const std::string& key) {
  const auto found = std::ranges::find(scene.probes, probe, &Probe::name);
  if (found != scene.probes.end()) return static_cast<std::size_t>(found - scene.probes.begin());
  std::string known;
  for (const Probe& each : scene.probes) known += (known.empty() ? "" : ", ") + each.name;
  throw SceneError(key, "there is no probe '" + probe + "'; name one of: " + known);
}

template <class Map>
auto find_or_null(const Map& map, const std::string& key) -> const typename Map::mapped_type* {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &found->second;
}

Source source_of(const Measure& measure, const Scene& scene, const Series& series,
                 const Reference* reference) {
  const std::string key = "measure." + measure.name;
  const std::size_t probe = probe_index(scene, measure.probe, key + ".probe");
  Source source;
  source.curve = finite_part({series.time, series.value.at(probe)});
  if (!measure.free.empty()) {
    source.free =
        finite_part({series.time, series.value.at(probe_index(scene, measure.free, key + ".free"))});
  }
  if (reference != nullptr) source.table = find_or_null(reference->table, measure.name);
  source.until = scene.until;
  source.turns = scene.probes[probe].kind != Probe::Kind::mirror_asymmetry;
  return source;
}

Value reference_value(const Measure& measure, const Reference* reference) {
  if (reference == nullptr) return std::nullopt;
  if (measure.kind == Measure::Kind::rmse) {
    return find_or_null(reference->table, measure.name) ? Value(0) : std::nullopt;
  }
  const double* value = find_or_null(reference->value, measure.name);
  return value == nullptr ? std::nullopt : Value(*value);
}

Value error_of(const Value& value, const Value& reference) {
  if (!value || !reference) return std::nullopt;
  const double difference = std::abs(*value - *reference);
  return *reference == 0 ? difference : difference / std::abs(*reference);
}

}  // namespace

std::vector<MeasureResult> measure(const Scene& scene, const Series& series, std::string_view law) {
  const Reference* reference = find_or_null(scene.references, std::string(law));
  std::vector<MeasureResult> results;
  for (const Measure& each : scene.measures) {
    MeasureResult result;
    result.name = each.name;
    result.unit = each.unit;
    result.value = value_of(each, source_of(each, scene, series, reference));
    result.reference = reference_value(each, reference);
    if (result.reference) result.reference_name = reference->name;
    result.error = error_of(result.value, result.reference);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace taut
