#include "engine/diagnostics/curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace taut {
namespace {

/// Vertex (time, value) of the parabola through samples k − 1, k, k + 1.
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
  return {curve.t.first(kept), curve.y.first(kept), curve.of_steps};
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

std::vector<HalfCycle> half_cycles(const Curve& curve, double level) {
  constexpr double round_off = 1e-9;  // of the greatest deviation
  constexpr double least = 1.0 / 20;  // of the previous peak
  std::vector<HalfCycle> found;
  const auto deviation = [&](std::size_t k) { return curve.y[k] - level; };
  double greatest = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) greatest = std::max(greatest, std::abs(deviation(k)));
  double begin = curve.t.empty() ? 0 : curve.t.front();
  std::size_t top = 0, over = 0;
  std::size_t crossed = 0;
  const auto end_half_cycle = [&] {
    const auto [time, peak] = vertex(curve, top);
    const double end = crossing_time(curve, crossed, level);
    if (!found.empty() || begin > curve.t.front() ||
        std::abs(deviation(0)) <= least * std::abs(deviation(top)))
      found.push_back({.begin = begin, .end = end, .peak = peak - level, .peak_at = time});
    begin = end;
    top = over;
    over = 0;
  };
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const double y = deviation(k);
    if (std::abs(y) <= round_off * greatest) continue;
    if (top == 0) {
      top = k;
    } else if (std::signbit(y) != std::signbit(deviation(top))) {
      if (over == 0) crossed = over = k;
      if (std::abs(y) > std::abs(deviation(over))) over = k;
      if (std::abs(y) > least * std::abs(deviation(top))) end_half_cycle();
    } else {
      over = 0;
      if (std::abs(y) > std::abs(deviation(top))) top = k;
    }
  }
  if (over != 0) end_half_cycle();
  return found;
}

std::optional<double> mean_of_periods(const Curve& curve) {
  if (curve.size() < 2) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(curve.y);
  const auto mean = [&](double begin, double end) { return integral(curve, begin, end) / (end - begin); };
  double level = mean(curve.t.front(), curve.t.back());
  constexpr int most = 50;
  for (int pass = 0; pass < most; ++pass) {
    const std::vector<HalfCycle> cycles = half_cycles(curve, level);
    if (cycles.size() < 2) return std::nullopt;
    const std::size_t whole = cycles.size() / 2 * 2;
    const double next = mean(cycles.front().begin, cycles[whole - 1].end);
    const bool same = std::abs(next - level) <= 1e-9 * (high - low);
    level = next;
    if (same) break;
  }
  return level;
}

double integral(const Curve& curve, double begin, double end) {
  double sum = 0;
  if (curve.of_steps) {
    for (std::size_t k = 1; k < curve.size(); ++k)
      sum += curve.y[k] * std::max(std::min(curve.t[k], end) - std::max(curve.t[k - 1], begin), 0.0);
    return sum;
  }
  const std::vector<double> times = joint_times(std::span(&curve, 1), begin, end);
  for (std::size_t k = 1; k < times.size(); ++k)
    sum += 0.5 * (times[k] - times[k - 1]) * (value_at(curve, times[k - 1]) + value_at(curve, times[k]));
  return sum;
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
  const double node = std::sqrt(3.0 / 5);  // Gauss–Legendre
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
