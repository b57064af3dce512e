#include "engine/diagnostics/curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace taut {
namespace {

/// The extremum of the parabola through samples k − 1, k and k + 1, which are unequally spaced; k's value if
/// they lie on a line.
std::pair<double, double> vertex(const Curve& c, std::size_t k) {
  const double before = (c.y[k] - c.y[k - 1]) / (c.t[k] - c.t[k - 1]);
  const double after = (c.y[k + 1] - c.y[k]) / (c.t[k + 1] - c.t[k]);
  const double curvature = (after - before) / (c.t[k + 1] - c.t[k - 1]);  // half the second derivative
  if (curvature == 0) return {c.t[k], c.y[k]};
  const double slope = before + curvature * (c.t[k] - c.t[k - 1]);
  return {c.t[k] - slope / (2 * curvature), c.y[k] - slope * slope / (4 * curvature)};
}

}  // namespace

Curve finite_part(Curve curve) {
  const auto end = std::ranges::find_if_not(curve.y, [](double y) { return std::isfinite(y); });
  const auto kept = static_cast<std::size_t>(end - curve.y.begin());
  return {curve.t.first(kept), curve.y.first(kept)};
}

double value_at(const Curve& curve, double time) {
  const auto next = std::ranges::upper_bound(curve.t, time);
  if (next == curve.t.begin()) return curve.y.front();
  if (next == curve.t.end()) return curve.y.back();
  const auto k = static_cast<std::size_t>(next - curve.t.begin());
  return std::lerp(curve.y[k - 1], curve.y[k], (time - curve.t[k - 1]) / (curve.t[k] - curve.t[k - 1]));
}

double crossing_time(const Curve& curve, std::size_t k, double level) {
  const double share = (level - curve.y[k - 1]) / (curve.y[k] - curve.y[k - 1]);
  return std::lerp(curve.t[k - 1], curve.t[k], std::clamp(share, 0.0, 1.0));
}

std::vector<HalfCycle> half_cycles(const Curve& curve) {
  constexpr double round_off = 1e-9;  // of the greatest value so far: counts as 0
  std::vector<HalfCycle> found;
  double greatest = 0;
  std::size_t top = 0;                              // of the half cycle in progress; 0 before the first
  for (std::size_t k = 1; k < curve.size(); ++k) {  // the start is 0, whatever its round-off
    const double y = curve.y[k];
    greatest = std::max(greatest, std::abs(y));
    if (std::abs(y) <= round_off * greatest) continue;
    if (top == 0) {
      top = k;
    } else if (std::signbit(y) != std::signbit(curve.y[top])) {
      const auto [time, peak] = vertex(curve, top);
      found.push_back({.end = crossing_time(curve, k, 0), .peak = peak, .peak_at = time});
      top = k;
    } else if (std::abs(y) > std::abs(curve.y[top])) {
      top = k;
    }
  }
  return found;
}

std::vector<double> joint_times(std::span<const Curve> curves, double begin, double end) {
  std::vector<double> times = {begin, end};
  const auto inside = [=](double t) { return begin < t && t < end; };
  for (const Curve& curve : curves) std::ranges::copy_if(curve.t, std::back_inserter(times), inside);
  std::ranges::sort(times);
  return times;
}

double rms_difference(const Curve& a, const Curve& b, double begin, double end) {
  const std::vector<double> times = joint_times(std::array{a, b}, begin, end);
  double integral = 0;
  double left = value_at(a, begin) - value_at(b, begin);
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double right = value_at(a, times[k]) - value_at(b, times[k]);
    integral += (times[k] - times[k - 1]) * (left * left + left * right + right * right) / 3;
    left = right;
  }
  return std::sqrt(integral / (end - begin));
}

double rms_difference(const Curve& a, const std::function<double(double)>& b, double begin, double end) {
  const double node = std::sqrt(3.0 / 5);  // of Gauss–Legendre, from −1 to 1
  const std::vector<double> times = joint_times(std::span(&a, 1), begin, end);
  double integral = 0;
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double middle = (times[k - 1] + times[k]) / 2, half = (times[k] - times[k - 1]) / 2;
    const auto square = [&](double at) {
      const double t = middle + at * half, difference = value_at(a, t) - b(t);
      return difference * difference;
    };
    integral += half * (5 * square(-node) + 8 * square(0) + 5 * square(node)) / 9;
  }
  return std::sqrt(integral / (end - begin));
}

double turn(const Curve& x, const Curve& y, double end) {
  double angle = 0, x0 = x.y.front(), y0 = y.y.front();
  for (const double t : joint_times(std::array{x, y}, x.t.front(), end)) {
    const double x1 = value_at(x, t), y1 = value_at(y, t);
    angle += std::atan2(x0 * y1 - y0 * x1, x0 * x1 + y0 * y1);
    x0 = x1, y0 = y1;
  }
  return angle;
}

}  // namespace taut
