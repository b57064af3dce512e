#include "engine/diagnostics/measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/diagnostics/curve.hpp"
#include "engine/diagnostics/field_error.hpp"
#include "engine/diagnostics/spectrum.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

using Value = std::optional<double>;

/// What a reference says over time, of each probe of a measure: a table or an exact solution, or neither.
struct ReferenceCurves {
  std::vector<Curve> table;
  const std::vector<Solution>* exact = nullptr;

  bool empty() const { return table.empty() && exact == nullptr; }
  double begin() const { return exact ? 0 : table.front().t.front(); }
  double end() const { return exact ? std::numeric_limits<double>::infinity() : table.front().t.back(); }
  double at(std::size_t probe, double t) const {
    return exact ? (*exact)[probe]({}, t) : value_at(table[probe], t);
  }
};

/// What a measure is made from.
struct Source {
  std::vector<Curve> curve;                          // of each probe
  std::optional<Curve> free;                         // final_ratio
  ReferenceCurves reference;                         // of measures that are compared with one
  const SampleLine* line = nullptr;                  // line_rmse
  const std::vector<LineSample>* samples = nullptr;  // of the line
  const Snapshot* now = nullptr;                     // field_rmse, field_error
  double until = 0;                                  // s
  bool turns = true;                                 // an extreme at the end is not the last word
};

/// The time that a run and the reference's curves both cover, up to the end of the run; nothing while the run
/// goes on within it.
std::optional<std::pair<double, double>> common_time(const Source& source) {
  if (source.reference.empty()) return std::nullopt;
  const double begin = std::max(source.curve.front().t.front(), source.reference.begin());
  const double end = std::min(source.until, source.reference.end());
  for (const Curve& curve : source.curve)
    if (curve.t.back() < end) return std::nullopt;
  return end > begin ? std::optional(std::pair(begin, end)) : std::nullopt;
}

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
  const auto time = common_time(source);
  if (!time) return std::nullopt;
  const auto& [begin, end] = *time;
  const ReferenceCurves& reference = source.reference;
  if (!reference.exact) return rms_difference(source.curve[0], reference.table[0], begin, end);
  return rms_difference(
      source.curve[0], [&](double t) { return reference.at(0, t); }, begin, end);
}

/// Seen at the rows of a table, since a path that bends is not straight between them, or at the steps.
Value path_error(const Source& source, double scale) {
  const auto time = common_time(source);
  if (!time) return std::nullopt;
  const ReferenceCurves& reference = source.reference;
  Value greatest;
  for (const double t : reference.exact ? source.curve[0].t : reference.table[0].t) {
    if (t < time->first || t > time->second) continue;
    double squared = 0;
    for (std::size_t k = 0; k < source.curve.size(); ++k)
      squared += std::pow(value_at(source.curve[k], t) - reference.at(k, t), 2);
    greatest = std::max(greatest.value_or(0), std::sqrt(squared) / scale);
  }
  return greatest;
}

Value turn(const std::vector<Curve>& point, double until) {
  const bool over = std::ranges::all_of(point, [=](const Curve& c) { return c.t.back() >= until; });
  return over ? Value(turn(point[0], point[1], until)) : std::nullopt;
}

/// Of an exact solution at the steps of the run.
Value reference_turn(const Source& source) {
  const ReferenceCurves& reference = source.reference;
  if (reference.empty()) return std::nullopt;
  if (!reference.exact) return turn(reference.table, source.until);
  const std::span<const double> t = source.curve[0].t;
  std::vector<double> x, y;
  for (const double time : t) {
    x.push_back(reference.at(0, time));
    y.push_back(reference.at(1, time));
  }
  return t.empty() ? std::nullopt : turn({Curve{t, x}, Curve{t, y}}, source.until);
}

Value extreme(const Source& source, double value) {
  return source.turns && source.curve[0].y.back() == value ? std::nullopt : Value(value);
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
    if (source.curve[0].y.back() / scale < 0) return std::nullopt;
  }
  return source.curve[0].y.back() / scale;
}

Value line_rmse(const Source& source) {
  if (!source.reference.exact || !source.samples) return std::nullopt;
  const SampleLine& line = *source.line;
  if (source.samples->size() < line.times.size() || source.samples->empty()) return std::nullopt;
  double sum = 0;
  for (const LineSample& sample : *source.samples)
    for (int k = 0; k < line.points; ++k)
      sum += std::pow(sample.value[static_cast<std::size_t>(k)] -
                          source.reference.exact->front()(line_point(line, k), sample.time),
                      2);
  return std::sqrt(sum / (static_cast<double>(line.points) * static_cast<double>(line.times.size())));
}

Value at_rest(const Curve& curve, double until) {
  constexpr double last = 0.1, still = 1e-3;  // of the run, of the greatest size of the series
  if (curve.t.back() < until) return std::nullopt;
  double size = 0, low = curve.y.back(), high = low;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    size = std::max(size, std::abs(curve.y[k]));
    if (curve.t[k] < (1 - last) * until) continue;
    low = std::min(low, curve.y[k]);
    high = std::max(high, curve.y[k]);
  }
  return high - low <= still * size ? Value(curve.y.back()) : std::nullopt;
}

Value field_difference(const Measure& measure, const Source& source) {
  if (!source.reference.exact || !source.now || source.now->time < source.until) return std::nullopt;
  const auto error = field_error(measure, *source.now, *source.reference.exact);
  if (!error) return std::nullopt;
  return measure.kind == Measure::Kind::field_rmse ? error->rms : error->greatest;
}

Value value_of(const Measure& measure, const Source& source) {
  if (measure.kind == Measure::Kind::line_rmse) return line_rmse(source);
  if (!measure.fields.empty()) return field_difference(measure, source);
  if (std::ranges::any_of(source.curve, [](const Curve& c) { return c.size() == 0; })) return std::nullopt;
  const Curve& curve = source.curve.front();
  switch (measure.kind) {
    case Measure::Kind::period:
      return period(curve);
    case Measure::Kind::first_peak:
      return first_peak(curve);
    case Measure::Kind::decay:
      return decay(curve);
    case Measure::Kind::rmse:
      return rmse(source);
    case Measure::Kind::minimum:
      return extreme(source, std::ranges::min(curve.y));
    case Measure::Kind::maximum:
      return extreme(source, std::ranges::max(curve.y));
    case Measure::Kind::first_below:
      return first_below(curve, measure.threshold);
    case Measure::Kind::last_below:
      return last_below(curve, measure.threshold);
    case Measure::Kind::final_ratio:
      return final_ratio(source, measure.scale, measure.threshold);
    case Measure::Kind::path_error:
      return path_error(source, measure.scale);
    case Measure::Kind::turn:
      return turn(source.curve, source.until);
    case Measure::Kind::at_rest:
      return at_rest(curve, source.until);
    case Measure::Kind::frequency:
      return curve.t.back() < source.until ? std::nullopt
                                           : peak_frequency(curve, measure.from, source.until, measure.band);
    case Measure::Kind::line_rmse:
    case Measure::Kind::field_rmse:
    case Measure::Kind::field_error:
      break;
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

ReferenceCurves reference_curves(const Measure& measure, const Reference* reference) {
  ReferenceCurves curves;
  if (reference == nullptr) return curves;
  curves.exact = find_or_null(reference->solution, measure.name);
  const ReferenceTable* table = find_or_null(reference->table, measure.name);
  if (table != nullptr && !table->t.empty())
    for (const std::vector<double>& column : table->value) curves.table.push_back({table->t, column});
  return curves;
}

using Samples = std::vector<std::vector<LineSample>>;

Source source_of(const Measure& measure, const Scene& scene, const Series& series, const Samples& lines,
                 const Reference* reference) {
  const std::string key = "measure." + measure.name;
  Source source;
  for (const std::string& name : measure.probes) {
    const std::size_t probe = probe_index(scene, name, key + ".probe");
    source.curve.push_back(finite_part({series.time, series.value.at(probe)}));
    if (scene.probes[probe].kind == Probe::Kind::mirror_asymmetry) source.turns = false;
  }
  if (!measure.free.empty()) {
    source.free =
        finite_part({series.time, series.value.at(probe_index(scene, measure.free, key + ".free"))});
  }
  source.reference = reference_curves(measure, reference);
  const auto line = std::ranges::find(scene.lines, measure.line, &SampleLine::name);
  const std::size_t l = static_cast<std::size_t>(line - scene.lines.begin());
  if (line != scene.lines.end()) source.line = &*line;
  if (l < lines.size()) source.samples = &lines[l];
  source.until = scene.until;
  return source;
}

Value reference_value(const Measure& measure, const Source& source, const Reference* reference) {
  if (reference == nullptr) return std::nullopt;
  switch (measure.kind) {
    case Measure::Kind::rmse:
    case Measure::Kind::path_error:
    case Measure::Kind::line_rmse:
    case Measure::Kind::field_rmse:
    case Measure::Kind::field_error:
      return source.reference.empty() ? std::nullopt : Value(0);
    case Measure::Kind::turn:
      return reference_turn(source);
    default: {
      if (source.reference.exact) return source.reference.at(0, source.until);
      const double* value = find_or_null(reference->value, measure.name);
      return value == nullptr ? std::nullopt : Value(*value);
    }
  }
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
    MeasureResult result;
    result.name = each.name;
    result.unit = each.unit;
    Source source = source_of(each, scene, series, lines, reference);
    source.now = now;
    result.value = value_of(each, source);
    result.reference = reference_value(each, source, reference);
    if (result.reference) result.reference_name = reference->name;
    result.error = error_of(result.value, result.reference);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace taut
