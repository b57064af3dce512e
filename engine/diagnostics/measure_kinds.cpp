#include "engine/diagnostics/measure_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

#include "engine/diagnostics/measures_in_space.hpp"
#include "engine/diagnostics/spectrum.hpp"

namespace taut {
namespace {

using Source = MeasureSource;
using Value = std::optional<double>;

/// Interval that the scene and the reference cover; none if it is empty or a series ends earlier.
std::optional<std::pair<double, double>> common_time(const Source& source) {
  if (source.reference.empty()) return std::nullopt;
  const double begin = std::max(source.curve.front().t.front(), source.reference.begin());
  const double end = std::min(source.until, source.reference.end());
  for (const Curve& curve : source.curve)
    if (curve.t.back() < end) return std::nullopt;
  return end > begin ? std::optional(std::pair(begin, end)) : std::nullopt;
}

Measured without_common_time(const Source& source) {
  if (source.reference.empty()) return none(no_reference);
  const double end = std::min(source.until, source.reference.end()), reached = source.curve.front().t.back();
  return reached < end ? too_short(end, reached) : none("the run and its reference do not overlap in time");
}

template <class Number>
Measured of_half_cycles(const Source& source, std::size_t needed, const Number& number) {
  const Curve& curve = source.curve.front();
  Value level = source.measure->about;
  if (source.measure->about_mean) level = mean_of_periods(curve);
  if (!level)
    return none("there is no whole cycle about the mean until {:g} s: use a longer run", curve.t.back());
  const std::vector<HalfCycle> cycles = half_cycles(curve, *level);
  if (cycles.size() >= needed) return number(cycles);
  const auto [low, high] = std::ranges::minmax(curve.y);
  if (std::max(low - *level, *level - high) >= -1e-9 * (high - low) && !source.measure->about_mean)
    return none(
        "the series stays on one side of {:g} until {:g} s: "
        "if it oscillates about another level, set about = \"mean\"",
        *level, curve.t.back());
  return none("the series has {} of {} half cycles about {:g} until {:g} s: use a longer run", cycles.size(),
              needed, *level, curve.t.back());
}

Measured period(const Source& source) {
  return of_half_cycles(source, 2, [](const auto& cycles) { return cycles[1].end - cycles[0].begin; });
}

Measured first_peak(const Source& s) {
  return of_half_cycles(s, 1, [](const auto& cycles) { return cycles[0].peak; });
}
Measured peak_time(const Source& s) {
  return of_half_cycles(s, 1, [](const auto& cycles) { return cycles[0].peak_at; });
}

double decay_of(const std::vector<HalfCycle>& cycles) {
  const std::size_t periods = (cycles.size() - 1) / 2;
  return 1 - std::pow(cycles[2 * periods].peak / cycles.front().peak, 1 / static_cast<double>(periods));
}

Measured decay(const Source& source) { return of_half_cycles(source, 3, decay_of); }

std::pair<double, double> span_of(const Source& source) {
  return {source.measure->from, source.measure->until.value_or(source.until)};
}

Measured starts_too_late(double begin, double end) {
  return none("`from` is {:g} s; it must be before the end of the run, {:g} s", begin, end);
}

Measured time_integral(const Source& source) {
  const auto [begin, end] = span_of(source);
  const Curve& curve = source.curve.front();
  if (!(begin < end)) return starts_too_late(begin, end);
  return curve.t.back() < end ? too_short(end, curve.t.back()) : Measured(integral(curve, begin, end));
}

Measured time_mean(const Source& source) {
  const auto [begin, end] = span_of(source);
  const Measured sum = time_integral(source);
  return sum.value ? Measured(*sum.value / (end - begin)) : sum;
}

Measured rmse(const Source& source) {
  const auto time = common_time(source);
  if (!time) return without_common_time(source);
  const auto& [begin, end] = *time;
  const ReferenceCurves& reference = source.reference;
  const auto exact = [&](double t) { return reference.at(0, t); };
  const double difference = reference.exact ? rms_difference(source.curve[0], exact, begin, end)
                                            : rms_difference(source.curve[0], reference.table[0], begin, end);
  return difference / std::abs(source.measure->scale);
}

/// Compares with a table at its times only, since paths are curved between them.
Measured path_error(const Source& source) {
  const auto time = common_time(source);
  if (!time) return without_common_time(source);
  const ReferenceCurves& reference = source.reference;
  Value greatest;
  for (const double t : reference.exact ? source.curve[0].t : reference.table[0].t) {
    if (t < time->first || t > time->second) continue;
    double squared = 0;
    for (std::size_t k = 0; k < source.curve.size(); ++k)
      squared += std::pow(value_at(source.curve[k], t) - reference.at(k, t), 2);
    greatest = std::max(greatest.value_or(0), std::sqrt(squared) / std::abs(source.measure->scale));
  }
  return greatest ? Measured(*greatest) : none("no time of the reference is within the run");
}

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

/// Requires equal times of all curves. `axis`: only in 3D.
Value turn_until(const std::vector<Curve>& point, const Point& axis, double until) {
  if (!std::ranges::all_of(point, [=](const Curve& c) { return c.t.back() >= until; })) return std::nullopt;
  if (point.size() < 3) return turn(point[0], point[1], until);
  const auto [first, second] = directions_across(axis);
  const std::vector<double> x = component(point, first), y = component(point, second);
  return turn({point[0].t, x}, {point[0].t, y}, until);
}

Measured turn_of_point(const Source& source) {
  const Value angle = turn_until(source.curve, source.measure->axis, source.until);
  return angle ? Measured(*angle) : too_short(source.until, source.curve.front().t.back());
}

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

Measured value_then(const Source& source) {
  const Curve& curve = source.curve.front();
  const double time = source.measure->time;
  return curve.t.back() < time ? too_short(time, curve.t.back()) : Measured(value_at(curve, time));
}

Value given_then(const Source& source) {
  return source.reference.exact ? source.reference.at(0, source.measure->time) : source.reference_value;
}

Measured extreme(const Source& source, double value) {
  const auto &t = source.curve[0].t, &y = source.curve[0].y;
  if (!source.end_extreme_may_grow || y.back() != value) return value;
  if (std::ranges::min(y) == std::ranges::max(y)) return none("the series is {:g} at all times", value);
  return none("the series has its extreme at the end, {:g} s: use a longer run", t.back());
}

Measured minimum(const Source& source) { return extreme(source, std::ranges::min(source.curve[0].y)); }
Measured maximum(const Source& source) { return extreme(source, std::ranges::max(source.curve[0].y)); }

Measured first_below(const Source& source) {
  const Curve& curve = source.curve.front();
  const double threshold = source.measure->threshold;
  const auto found = std::ranges::find_if(curve.y, [=](double y) { return y <= threshold; });
  if (found == curve.y.end()) return none("the series is above {:g} until {:g} s", threshold, curve.t.back());
  const auto k = static_cast<std::size_t>(found - curve.y.begin());
  return k == 0 ? curve.t.front() : crossing_time(curve, k, threshold);
}

Measured last_below(const Source& source) {
  const Curve& curve = source.curve.front();
  const double threshold = source.measure->threshold;
  std::size_t above = curve.size();
  while (above > 0 && curve.y[above - 1] > threshold) --above;
  if (above == 0) return none("the series was never {:g} or less", threshold);
  if (above == curve.size())
    return none("the series is {:g} or less at the end, {:g} s", threshold, curve.t.back());
  return crossing_time(curve, above, threshold);
}

Measured final_ratio(const Source& source) {
  const double ratio = source.curve[0].y.back() / source.measure->scale;
  if (!source.free) return ratio;
  if (source.free->t.back() < source.curve[0].t.back())
    return none("{} is not finite after {:g} s", source.measure->free, source.free->t.back());
  const auto& gap = source.free->y;
  const double threshold = source.measure->threshold, end = source.free->t.back();
  const bool touched = std::ranges::any_of(gap, [&](double y) { return y <= threshold; });
  if (!touched) return none("the bodies have not touched until {:g} s", end);
  if (gap.back() <= threshold) return none("the bodies still touch at the end, {:g} s", end);
  if (ratio < 0) return none("the bodies have not rebounded at the end, {:g} s", end);
  return ratio;
}

Measured frequency(const Source& source) {
  const Curve& curve = source.curve.front();
  if (curve.t.back() < source.until) return too_short(source.until, curve.t.back());
  const std::array<double, 2>& band = source.measure->band;
  if (!(source.measure->from < source.until)) return starts_too_late(source.measure->from, source.until);
  if (const Value peak = peak_frequency(curve, source.measure->from, source.until, band)) return *peak;
  return none("the spectrum has no peak between {:g} and {:g} Hz", band[0], band[1]);
}

Measured at_rest(const Source& source) {
  constexpr double last = 0.1, still = 1e-3;  // of the run; of the greatest |value|
  const Curve& curve = source.curve.front();
  if (curve.t.back() < source.until) return too_short(source.until, curve.t.back());
  double size = 0, low = curve.y.back(), high = low;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    size = std::max(size, std::abs(curve.y[k]));
    if (curve.t[k] < (1 - last) * source.until) continue;
    low = std::min(low, curve.y[k]);
    high = std::max(high, curve.y[k]);
  }
  if (high - low <= still * size) return curve.y.back();
  return none(
      "the series varies by {:g} of its greatest size in the last tenth of the run: "
      "use a longer run or more damping",
      (high - low) / size);
}

Value zero(const Source& source) { return source.reference.empty() ? std::nullopt : Value(0); }

Value as_given(const Source& source) {
  return source.reference.exact ? source.reference.at(0, source.until) : source.reference_value;
}

const std::vector<MeasureKind> kinds = {
    {.name = "period",
     .help = "duration of the first whole cycle about the level `about` (0, a number, or \"mean\": "
             "the mean over whole periods): time between two crossings in the same direction; "
             "a start at the level counts as a crossing",
     .keys = {"probe", "about"},
     .number = true,
     .value = period,
     .reference = as_given},
    {.name = "first_peak",
     .help = "greatest deviation from the level `about` in the first half cycle, with its sign; "
             "needs the end of the half cycle",
     .keys = {"probe", "about"},
     .number = true,
     .value = first_peak,
     .reference = as_given},
    {.name = "peak_time",
     .help = "time of the first peak",
     .keys = {"probe", "about"},
     .number = true,
     .value = peak_time,
     .reference = as_given},
    {.name = "decay",
     .help =
         "loss of amplitude per period: "
         "1 − (A_n/A_1)^(1/(n−1)) of the n ≥ 2 peaks on the same side of the level `about` as the first peak",
     .keys = {"probe", "about"},
     .number = true,
     .value = decay,
     .reference = as_given},
    {.name = "mean",
     .help =
         "mean over time, 1/T ∫ series dt, T from `from` (default 0) to `until` (default the end of the run)",
     .keys = {"probe", "from", "until"},
     .number = true,
     .value = time_mean,
     .reference = as_given},
    {.name = "integral",
     .help = "∫ series dt from `from` (default 0) to `until` (default the end of the run); "
             "for a force, the impulse",
     .keys = {"probe", "from", "until"},
     .number = true,
     .value = time_integral,
     .reference = as_given},
    {.name = "rmse",
     .help =
         "√(1/T ∫ (series − reference)² dt) over the time T that both cover, divided by `scale` (default 1)",
     .keys = {"probe", "scale"},
     .table = true,
     .solution = true,
     .value = rmse,
     .reference = zero},
    {.name = "value",
     .help = "value of the series at `time`, given in s",
     .keys = {"probe", "time"},
     .number = true,
     .solution = true,
     .value = value_then,
     .reference = given_then},
    {.name = "minimum",
     .help = "least value; none if the series ends at it, except for a mirror_asymmetry",
     .keys = {"probe"},
     .number = true,
     .value = minimum,
     .reference = as_given},
    {.name = "maximum",
     .help = "greatest value; none if the series ends at it, except for a mirror_asymmetry",
     .keys = {"probe"},
     .number = true,
     .value = maximum,
     .reference = as_given},
    {.name = "first_below",
     .help = "first time at which the series is ≤ `threshold`",
     .keys = {"probe", "threshold"},
     .number = true,
     .value = first_below,
     .reference = as_given},
    {.name = "last_below",
     .help = "last time at which the series was ≤ `threshold`; none unless it is above at the end",
     .keys = {"probe", "threshold"},
     .number = true,
     .value = last_below,
     .reference = as_given},
    {.name = "final_ratio",
     .help = "last value divided by `scale`; with a series `free`, "
             "none unless `free` was ≤ `threshold` and is above it at the end, and the ratio is ≥ 0",
     .keys = {"probe", "threshold", "scale", "free"},
     .number = true,
     .value = final_ratio,
     .reference = as_given},
    {.name = "path_error",
     .help =
         "greatest distance of the point from its reference position at the same time, divided by `scale`",
     .keys = {"probes", "scale"},
     .table = true,
     .solution = true,
     .value = path_error,
     .reference = zero},
    {.name = "frequency",
     .help =
         "frequency of the highest peak of the spectrum within `band` (in Hz), for the series after `from`",
     .keys = {"probe", "band", "from"},
     .number = true,
     .value = frequency,
     .reference = as_given},
    {.name = "turn",
     .help = "angle by which the point turns about the origin, rad, counter-clockwise, with whole turns; "
             "in 3D about `axis` through the origin (default [0, 0, 1], right-handed)",
     .keys = {"probes", "axis"},
     .table = true,
     .solution = true,
     .value = turn_of_point,
     .reference = turn_of_reference},
    {.name = "line_rmse",
     .help = "root mean square of field − reference over all points and times of the line",
     .keys = {"line"},
     .table = true,
     .solution = true,
     .value = line_rmse,
     .reference = zero},
    {.name = "line_error",
     .help = "line_rmse divided by the root mean square of the reference over the same points and times",
     .keys = {"line"},
     .table = true,
     .solution = true,
     .value = line_error,
     .reference = zero},
    {.name = "at_rest",
     .help =
         "value at the end; "
         "none if the series varies by more than 1/1000 of its greatest size in the last tenth of the run",
     .keys = {"probe"},
     .number = true,
     .solution = true,
     .value = at_rest,
     .reference = as_given},
    {.name = "field_rmse",
     .help = "root mean square of |fields − reference| over the unclamped particles of the body at the end, "
             "divided by the greatest |reference|",
     .keys = {"body", "fields", "rigid_motion"},
     .solution = true,
     .value = field_rmse,
     .reference = zero},
    {.name = "field_error",
     .help = "greatest |fields − reference| of an unclamped particle of the body at the end, "
             "divided by the greatest |reference|",
     .keys = {"body", "fields", "rigid_motion"},
     .solution = true,
     .value = greatest_field_error,
     .reference = zero},
    {.name = "volume_change",
     .help =
         "relative change of the volume of the body at the end, summed over the cells between its particles; "
         "none unless its lattice is along the axes",
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
