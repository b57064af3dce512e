#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace taut {

struct Curve {
  std::span<const double> t, y;
  bool of_steps = false;  // means over steps

  std::size_t size() const { return t.size(); }
};

Curve finite_part(Curve curve);

/// Linear between samples.
double value_at(const Curve& curve, double time);

double crossing_time(const Curve& curve, std::size_t k, double level);

struct HalfCycle {
  double begin, end;  // s
  double peak;        // greatest deviation from the level, signed
  double peak_at;     // s
};

/// Complete half cycles, from the start if it is at the level, else from the first crossing. Excursions that stay below
/// 1/20 of the previous peak and return are noise.
std::vector<HalfCycle> half_cycles(const Curve& curve, double level = 0);

/// Mean over whole periods between crossings of this mean; none without a whole period.
std::optional<double> mean_of_periods(const Curve& curve);

/// ∫ y dt; requires begin < end within the curve.
double integral(const Curve& curve, double begin, double end);

std::vector<double> joint_times(std::span<const Curve> curves, double begin, double end);

/// RMS of a − b, exact for linear interpolation; requires begin < end within both curves.
double rms_difference(const Curve& a, const Curve& b, double begin, double end);
/// RMS with three Gauss points between samples of `a`.
double rms_difference(const Curve& a, const std::function<double(double)>& b, double begin, double end);

/// Angle by which (x, y) turns about the origin until `end`, rad; requires less than half a turn per sample.
double turn(const Curve& x, const Curve& y, double end);

}  // namespace taut
