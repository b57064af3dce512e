#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace taut {

/// Linear between samples.
struct Curve {
  std::span<const double> t, y;
  bool of_steps = false;  // samples are means since the previous sample

  std::size_t size() const { return t.size(); }
};

/// Samples before the first non-finite one.
Curve finite_part(Curve curve);

double value_at(const Curve& curve, double time);

/// Between samples k − 1 and k.
double crossing_time(const Curve& curve, std::size_t k, double level);

/// Between two crossings of a level.
struct HalfCycle {
  double begin, end;
  double peak;  // greatest deviation, a vertex through three samples
  double peak_at;
};

/// Complete half cycles, from a start at the level or the first crossing. Excursions below 1/20 of the previous peak
/// are noise.
std::vector<HalfCycle> half_cycles(const Curve& curve, double level = 0);

/// Mean over whole periods, between two crossings of this mean in the same direction; none without a whole period.
std::optional<double> mean_of_periods(const Curve& curve);

/// Exact; begin < end within the curve.
double integral(const Curve& curve, double begin, double end);

/// Returns `begin`, `end` and all sample times between them.
std::vector<double> joint_times(std::span<const Curve> curves, double begin, double end);

/// Exact RMS of a − b; begin < end within both curves.
double rms_difference(const Curve& a, const Curve& b, double begin, double end);
/// Three Gauss points between samples of `a`.
double rms_difference(const Curve& a, const std::function<double(double)>& b, double begin, double end);

/// Angle by which (x, y) turns about the origin until `end`, rad, counter-clockwise, with full turns; below half a
/// turn per sample.
double turn(const Curve& x, const Curve& y, double end);

}  // namespace taut
