#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace taut {

/// A quantity over time: straight between its samples. The times increase; both spans are equally long.
struct Curve {
  std::span<const double> t, y;
  bool of_steps = false;  // a sample is the mean since the one before, as that of a force

  std::size_t size() const { return t.size(); }
};

/// The samples before the first that is not finite.
Curve finite_part(Curve curve);

/// The value at a time within the curve.
double value_at(const Curve& curve, double time);

/// When the curve passes `level` between the samples before `k` and `k`.
double crossing_time(const Curve& curve, std::size_t k, double level);

/// What lies between two crossings of a level.
struct HalfCycle {
  double begin, end;  // times of both
  double peak;        // greatest deviation from the level, at the vertex of a parabola through three samples
  double peak_at;     // its time
};

/// Every half cycle that has ended. The first one begins at the start of a curve that starts at the level,
/// else at the first crossing. Where a curve comes back after less than a twentieth of the peak before, it
/// has not crossed: it has noise, or touches the level from one side.
std::vector<HalfCycle> half_cycles(const Curve& curve, double level = 0);

/// The level about which a curve swings: its mean over whole periods, from one crossing of that level to
/// another in the same direction, so that a last cycle that is cut short does not count. None if there is no
/// whole period.
std::optional<double> mean_of_periods(const Curve& curve);

/// ∫ y dt, exact for either kind of samples; begin < end lie within the curve.
double integral(const Curve& curve, double begin, double end);

/// Begin, end and the samples of all curves in between: each curve is straight from one to the next.
std::vector<double> joint_times(std::span<const Curve> curves, double begin, double end);

/// √(1/(end − begin) ∫ (a − b)² dt), exact; begin < end lie within both curves.
double rms_difference(const Curve& a, const Curve& b, double begin, double end);
/// The same with a function of time: three Gauss points between two samples of `a`.
double rms_difference(const Curve& a, const std::function<double(double)>& b, double begin, double end);

/// The angle by which the point (x, y) turns about the origin from the first sample to `end`, rad,
/// counter-clockwise positive, full turns counted: between two samples it is less than half a turn.
double turn(const Curve& x, const Curve& y, double end);

}  // namespace taut
