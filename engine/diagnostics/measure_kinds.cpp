#include "engine/diagnostics/measure_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

#include "engine/diagnostics/field_error.hpp"
#include "engine/diagnostics/lattice_volume.hpp"
#include "engine/diagnostics/spectrum.hpp"

namespace taut {
namespace {

using Source = MeasureSource;
using Value = std::optional<double>;

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

Value period(const Source& source) {
  const std::vector<HalfCycle> cycles = half_cycles(source.curve.front());
  return cycles.size() < 2 ? std::nullopt : Value(cycles[1].end);
}

Value first_peak(const Source& source) {
  const std::vector<HalfCycle> cycles = half_cycles(source.curve.front());
  return cycles.empty() ? std::nullopt : Value(cycles.front().peak);
}

Value peak_time(const Source& source) {
  const std::vector<HalfCycle> cycles = half_cycles(source.curve.front());
  return cycles.empty() ? std::nullopt : Value(cycles.front().peak_at);
}

Value decay(const Source& source) {
  const std::vector<HalfCycle> cycles = half_cycles(source.curve.front());
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
  const auto exact = [&](double t) { return reference.at(0, t); };
  const double difference = reference.exact ? rms_difference(source.curve[0], exact, begin, end)
                                            : rms_difference(source.curve[0], reference.table[0], begin, end);
  return difference / std::abs(source.measure->scale);
}

/// Seen at the rows of a table, since a path that bends is not straight between them, or at the steps.
Value path_error(const Source& source) {
  const auto time = common_time(source);
  if (!time) return std::nullopt;
  const ReferenceCurves& reference = source.reference;
  Value greatest;
  for (const double t : reference.exact ? source.curve[0].t : reference.table[0].t) {
    if (t < time->first || t > time->second) continue;
    double squared = 0;
    for (std::size_t k = 0; k < source.curve.size(); ++k)
      squared += std::pow(value_at(source.curve[k], t) - reference.at(k, t), 2);
    greatest = std::max(greatest.value_or(0), std::sqrt(squared) / source.measure->scale);
  }
  return greatest;
}

/// Two directions across the axis: first, second and axis are right-handed.
std::pair<Point, Point> directions_across(const Point& axis) {
  const Eigen::Vector3d a(axis.data());
  const Eigen::Vector3d first = a.unitOrthogonal(), second = a.cross(first);
  return {{first[0], first[1], first[2]}, {second[0], second[1], second[2]}};
}

std::vector<double> component(const std::vector<Curve>& point, const Point& along) {
  std::vector<double> y(point[0].size());
  for (std::size_t k = 0; k < y.size(); ++k)
    for (std::size_t a = 0; a < point.size(); ++a) y[k] += along[a] * point[a].y[k];
  return y;
}

/// In 3D the point is seen along the axis. The curves of a point have the same times.
Value turn_until(const std::vector<Curve>& point, const Point& axis, double until) {
  if (!std::ranges::all_of(point, [=](const Curve& c) { return c.t.back() >= until; })) return std::nullopt;
  if (point.size() < 3) return turn(point[0], point[1], until);
  const auto [first, second] = directions_across(axis);
  const std::vector<double> x = component(point, first), y = component(point, second);
  return turn({point[0].t, x}, {point[0].t, y}, until);
}

Value turn_of_point(const Source& source) {
  return turn_until(source.curve, source.measure->axis, source.until);
}

/// Of an exact solution at the steps of the run.
Value turn_of_reference(const Source& source) {
  const ReferenceCurves& reference = source.reference;
  if (reference.empty()) return std::nullopt;
  const Point& axis = source.measure->axis;
  if (!reference.exact) return turn_until(reference.table, axis, source.until);
  const std::span<const double> t = source.curve[0].t;
  if (t.empty()) return std::nullopt;
  std::vector<std::vector<double>> x(source.curve.size());
  std::vector<Curve> point;
  for (std::size_t a = 0; a < x.size(); ++a) {
    for (const double time : t) x[a].push_back(reference.at(a, time));
    point.push_back({t, x[a]});
  }
  return turn_until(point, axis, source.until);
}

Value value_then(const Source& source) {
  const Curve& curve = source.curve.front();
  const double time = source.measure->time;
  return curve.t.back() < time ? std::nullopt : Value(value_at(curve, time));
}

/// A number, or a solution at the time of the measure.
Value given_then(const Source& source) {
  return source.reference.exact ? source.reference.at(0, source.measure->time) : source.reference_value;
}

/// An extreme at the end may still be ahead. What is no quantity but a fault that grows counts as it is.
Value extreme(const Source& source, double value) {
  return source.turns && source.curve[0].y.back() == value ? std::nullopt : Value(value);
}

Value minimum(const Source& source) { return extreme(source, std::ranges::min(source.curve[0].y)); }
Value maximum(const Source& source) { return extreme(source, std::ranges::max(source.curve[0].y)); }

Value first_below(const Source& source) {
  const Curve& curve = source.curve.front();
  const double threshold = source.measure->threshold;
  const auto found = std::ranges::find_if(curve.y, [=](double y) { return y <= threshold; });
  if (found == curve.y.end()) return std::nullopt;
  const auto k = static_cast<std::size_t>(found - curve.y.begin());
  return k == 0 ? curve.t.front() : crossing_time(curve, k, threshold);
}

Value last_below(const Source& source) {
  const Curve& curve = source.curve.front();
  const double threshold = source.measure->threshold;
  std::size_t above = curve.size();  // the first sample of the last stretch above
  while (above > 0 && curve.y[above - 1] > threshold) --above;
  if (above == 0 || above == curve.size()) return std::nullopt;
  return crossing_time(curve, above, threshold);
}

/// None while the bodies are in touch, if they never were, and while the ratio is negative: bodies that part
/// for a moment go on as before.
Value final_ratio(const Source& source) {
  const double ratio = source.curve[0].y.back() / source.measure->scale;
  if (!source.free) return ratio;
  const auto& gap = source.free->y;
  const double threshold = source.measure->threshold;
  const bool touched = std::ranges::any_of(gap, [&](double y) { return y <= threshold; });
  return !touched || gap.back() <= threshold || ratio < 0 ? std::nullopt : Value(ratio);
}

Value frequency(const Source& source) {
  const Curve& curve = source.curve.front();
  if (curve.t.back() < source.until) return std::nullopt;
  return peak_frequency(curve, source.measure->from, source.until, source.measure->band);
}

/// Of a line's difference from its reference, and of the reference.
struct LineSquares {
  double difference = 0, reference = 0;  // √ of the mean
};

/// The reference at the time of the step that was sampled, or a table, at its only time; none before the last
/// sample, and where a point has left the body.
std::optional<LineSquares> line_squares(const Source& source) {
  if (source.reference.empty() || !source.samples) return std::nullopt;
  const SampleLine& line = *source.line;
  if (source.samples->size() < line.times.size() || source.samples->empty()) return std::nullopt;
  const double apart = std::hypot(std::hypot(line.to[0] - line.from[0], line.to[1] - line.from[1]),
                                  line.to[2] - line.from[2]) /
                       (line.points - 1);
  LineSquares mean;
  for (const LineSample& sample : *source.samples) {
    for (int k = 0; k < line.points; ++k) {
      const ReferenceCurves& reference = source.reference;
      const double is = sample.value[static_cast<std::size_t>(k)];
      const double should = reference.exact ? reference.exact->front()(line_point(line, k), sample.time)
                                            : value_at(reference.table.front(), k * apart);
      mean.difference += (is - should) * (is - should);
      mean.reference += should * should;
    }
  }
  const double number = static_cast<double>(line.points) * static_cast<double>(line.times.size());
  if (!std::isfinite(mean.difference)) return std::nullopt;
  return LineSquares{std::sqrt(mean.difference / number), std::sqrt(mean.reference / number)};
}

Value line_rmse(const Source& source) {
  const auto mean = line_squares(source);
  return mean ? Value(mean->difference) : std::nullopt;
}

Value line_error(const Source& source) {
  const auto mean = line_squares(source);
  return mean && mean->reference > 0 ? Value(mean->difference / mean->reference) : std::nullopt;
}

Value at_rest(const Source& source) {
  constexpr double last = 0.1, still = 1e-3;  // of the run, of the greatest size of the series
  const Curve& curve = source.curve.front();
  if (curve.t.back() < source.until) return std::nullopt;
  double size = 0, low = curve.y.back(), high = low;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    size = std::max(size, std::abs(curve.y[k]));
    if (curve.t[k] < (1 - last) * source.until) continue;
    low = std::min(low, curve.y[k]);
    high = std::max(high, curve.y[k]);
  }
  return high - low <= still * size ? Value(curve.y.back()) : std::nullopt;
}

/// Particles that are not held, in their places at the start; none before the end of the run.
std::optional<FieldError> error_at_end(const Source& source) {
  if (!source.reference.exact || !source.now || source.now->time < source.until) return std::nullopt;
  return field_error(*source.measure, *source.now, *source.reference.exact);
}

Value field_rmse(const Source& source) {
  const auto error = error_at_end(source);
  return error ? Value(error->rms) : std::nullopt;
}

Value greatest_field_error(const Source& source) {
  const auto error = error_at_end(source);
  return error ? Value(error->greatest) : std::nullopt;
}

Value volume_change(const Source& source) {
  if (!source.now || source.now->time < source.until) return std::nullopt;
  const double before = lattice_volume(*source.now, source.measure->body, source.now->x0);
  if (!(before > 0)) return std::nullopt;
  return lattice_volume(*source.now, source.measure->body, source.now->x) / before - 1;
}

/// Of a measure that is a difference from its reference: it is its own error.
Value zero(const Source& source) { return source.reference.empty() ? std::nullopt : Value(0); }

/// A number, or a solution at the end of the run.
Value as_given(const Source& source) {
  return source.reference.exact ? source.reference.at(0, source.until) : source.reference_value;
}

const std::vector<MeasureKind> kinds = {
    {.name = "period",
     .help = "time of the second zero crossing of a series that starts at 0",
     .keys = {"probe"},
     .number = true,
     .value = period,
     .reference = as_given},
    {.name = "first_peak",
     .help = "first extremum of a series that starts at 0, with its sign, once the half cycle is over",
     .keys = {"probe"},
     .number = true,
     .value = first_peak,
     .reference = as_given},
    {.name = "peak_time",
     .help = "time of the first peak",
     .keys = {"probe"},
     .number = true,
     .value = peak_time,
     .reference = as_given},
    {.name = "decay",
     .help =
         "loss of amplitude per period: 1 − (A_n/A_1)^(1/(n−1)) of the n ≥ 2 peaks on the first one's side",
     .keys = {"probe"},
     .number = true,
     .value = decay,
     .reference = as_given},
    {.name = "rmse",
     .help =
         "√(1/T ∫ (series − reference)² dt) over the time T that both cover, over scale (1 unless given, as "
         "by the range of the reference)",
     .keys = {"probe", "scale"},
     .table = true,
     .solution = true,
     .value = rmse,
     .reference = zero},
    {.name = "value",
     .help = "of the series at the time `time`, s",
     .keys = {"probe", "time"},
     .number = true,
     .solution = true,
     .value = value_then,
     .reference = given_then},
    {.name = "minimum",
     .help = "least value; none while the series ends at it",
     .keys = {"probe"},
     .number = true,
     .value = minimum,
     .reference = as_given},
    {.name = "maximum",
     .help = "greatest value; none while the series ends at it, unless it is a mirror_asymmetry",
     .keys = {"probe"},
     .number = true,
     .value = maximum,
     .reference = as_given},
    {.name = "first_below",
     .help = "first time at which the series is ≤ threshold",
     .keys = {"probe", "threshold"},
     .number = true,
     .value = first_below,
     .reference = as_given},
    {.name = "last_below",
     .help = "last time at which the series was ≤ threshold; none unless it is above at the end",
     .keys = {"probe", "threshold"},
     .number = true,
     .value = last_below,
     .reference = as_given},
    {.name = "final_ratio",
     .help = "last value over scale; none unless the series `free` was ≤ threshold and is above at the end",
     .keys = {"probe", "threshold", "scale", "free"},
     .number = true,
     .value = final_ratio,
     .reference = as_given},
    {.name = "path_error",
     .help = "greatest distance of the point from where the reference has it at the same time, over scale",
     .keys = {"probes", "scale"},
     .table = true,
     .solution = true,
     .value = path_error,
     .reference = zero},
    {.name = "frequency",
     .help = "of the highest peak of the spectrum within band, of the series from the time `from` on, Hz",
     .keys = {"probe", "band", "from"},
     .number = true,
     .value = frequency,
     .reference = as_given},
    {.name = "turn",
     .help =
         "angle by which the point turns about the origin, rad, counter-clockwise, whole turns counted; in "
         "3D about an axis through it, [0, 0, 1] unless given, right-handed",
     .keys = {"probes", "axis"},
     .table = true,
     .solution = true,
     .value = turn_of_point,
     .reference = turn_of_reference},
    {.name = "line_rmse",
     .help = "√ of the mean of (field − reference)² over all points and times of the line",
     .keys = {"line"},
     .table = true,
     .solution = true,
     .value = line_rmse,
     .reference = zero},
    {.name = "line_error",
     .help = "line_rmse over √ of the mean of reference² over the same points and times",
     .keys = {"line"},
     .table = true,
     .solution = true,
     .value = line_error,
     .reference = zero},
    {.name = "at_rest",
     .help = "value at the end; none where the last tenth still moves by a thousandth of the greatest size",
     .keys = {"probe"},
     .number = true,
     .solution = true,
     .value = at_rest,
     .reference = as_given},
    {.name = "field_rmse",
     .help = "√ of the mean of |fields − reference|² over the body at the end, over the greatest |reference|",
     .keys = {"body", "fields", "rigid_motion"},
     .solution = true,
     .value = field_rmse,
     .reference = zero},
    {.name = "field_error",
     .help = "greatest |fields − reference| in the body at the end, over the greatest |reference|",
     .keys = {"body", "fields", "rigid_motion"},
     .solution = true,
     .value = greatest_field_error,
     .reference = zero},
    {.name = "volume_change",
     .help =
         "of the body at the end, over its volume at the start: of the cells between its particles, which "
         "stand on a lattice along the axes; none of another body",
     .keys = {"body"},
     .number = true,
     .value = volume_change,
     .reference = as_given},
};

}  // namespace

std::span<const MeasureKind> measure_kinds() { return kinds; }

const MeasureKind* find_measure_kind(std::string_view name) {
  const auto found = std::ranges::find(kinds, name, &MeasureKind::name);
  return found == kinds.end() ? nullptr : &*found;
}

}  // namespace taut
