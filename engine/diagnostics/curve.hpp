#pragma once

#include <functional>
#include <span>
#include <vector>

namespace taut {

/// A quantity over time: straight between its samples. The times increase; both spans are equally long.
struct Curve {
  std::span<const double> t, y;

  std::size_t size() const { return t.size(); }
};

/// The samples before the first that is not finite.
Curve finite_part(Curve curve);

/// The value at a time within the curve.
double value_at(const Curve& curve, double time);

/// When the curve passes `level` between the samples before `k` and `k`.
double crossing_time(const Curve& curve, std::size_t k, double level);

/// What lies between two crossings of zero.
struct HalfCycle {
  double end;      // time of the second
  double peak;     // value farthest from zero, at the vertex of a parabola through three samples
  double peak_at;  // its time
};

/// Every half cycle that has ended, of a curve that starts at 0; the first one begins at the start.
std::vector<HalfCycle> half_cycles(const Curve& curve);

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
