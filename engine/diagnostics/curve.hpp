#pragma once

#include <optional>
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
  double end;   // time of the second
  double peak;  // value farthest from zero, at the vertex of a parabola through three samples
};

/// Every half cycle that has ended, of a curve that starts at 0; the first one begins at the start.
std::vector<HalfCycle> half_cycles(const Curve& curve);

/// √(1/(end − begin) ∫ (a − b)² dt), exact; begin < end lie within both curves.
double rms_difference(const Curve& a, const Curve& b, double begin, double end);

}  // namespace taut
