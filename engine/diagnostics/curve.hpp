#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace taut {

/// A quantity over time, linear between samples. Times increase.
struct Curve {
  std::span<const double> t, y;
  bool of_steps = false;  // samples are means since the previous one, as for forces

  std::size_t size() const { return t.size(); }
};

/// Samples before the first non-finite one.
Curve finite_part(Curve curve);

/// Value at a time within the curve.
double value_at(const Curve& curve, double time);

/// Time at which the curve crosses `level` between samples k − 1 and k.
double crossing_time(const Curve& curve, std::size_t k, double level);

/// Part of a curve between two crossings of a level.
struct HalfCycle {
  double begin, end;
  double peak;     // greatest deviation from the level: vertex of a parabola through three samples
  double peak_at;  // its time
};

/// Completed half cycles. The first begins at the start if the curve starts at the level, else at the first crossing.
/// Excursions below 1/20 of the previous peak do not count as crossings: they are noise or tangency.
std::vector<HalfCycle> half_cycles(const Curve& curve, double level = 0);

/// Mean of the curve over whole periods between equal crossings of this mean. None without a whole period.
std::optional<double> mean_of_periods(const Curve& curve);

/// ∫ y dt, exact for both kinds of samples; begin < end within the curve.
double integral(const Curve& curve, double begin, double end);

/// Begin, end and all samples of the curves between them, sorted.
std::vector<double> joint_times(std::span<const Curve> curves, double begin, double end);

/// √(1/(end − begin) ∫ (a − b)² dt), exact; begin < end within both curves.
double rms_difference(const Curve& a, const Curve& b, double begin, double end);
/// For a function of time: three Gauss points between samples of `a`.
double rms_difference(const Curve& a, const std::function<double(double)>& b, double begin, double end);

/// Angle by which the point (x, y) turns about the origin from the first sample to `end`, rad, counter-clockwise,
/// including full turns. Between samples it must turn by less than half a turn.
double turn(const Curve& x, const Curve& y, double end);

}  // namespace taut
