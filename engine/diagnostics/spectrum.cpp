#include "engine/diagnostics/spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <ranges>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace taut {
namespace {

constexpr std::size_t padding = 4;

/// `n` values at even times, the mean under the window taken off, under the window.
std::vector<double> windowed(const Curve& curve, double begin, double end, std::size_t n) {
  std::vector<double> window(n), y(n);
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(n);
    window[k] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * share);
    y[k] = value_at(curve, begin + share * (end - begin));
    sum += window[k] * y[k];
    weights += window[k];
  }
  for (std::size_t k = 0; k < n; ++k) y[k] = window[k] * (y[k] - sum / weights);
  return y;
}

/// Of the parabola through three values one apart: where its top lies from the middle one.
double vertex(double left, double middle, double right) {
  const double bend = left - 2 * middle + right;
  return bend < 0 ? 0.5 * (left - right) / bend : 0;
}

/// The greatest of the heights as far as 1/(end − begin) to both sides: the window's own zeros lie as close.
template <class Height>
std::vector<double> without_zeros(std::size_t n, const Height& height) {
  std::vector<double> hull(n);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t other = k - std::min(k, padding); other < std::min(k + padding + 1, n); ++other)
      hull[k] = std::max(hull[k], height(other));
  return hull;
}

/// A line is a summit: on both sides, beyond its own width, it goes down to half of its height or less. What a trend
/// leaves goes down to one side alone, and what a blow leaves to none for long. Of a few periods only, between which
/// and the mean there is no room, nothing slower may be higher, and what is faster is low at once.
bool stands_out(const std::vector<double>& hull, std::size_t k) {
  constexpr std::size_t width = 3 * padding, slowest = 2 * padding;
  const auto low = [=](double height) { return height <= 0.5 * hull[k]; };
  const auto at = [&](std::size_t place) {
    return hull.begin() + static_cast<std::ptrdiff_t>(std::min(place, hull.size()));
  };
  if (k <= slowest + width)
    return *std::max_element(hull.begin(), at(k)) <= hull[k] && k + width < hull.size() &&
           low(hull[k + width]);
  return std::any_of(at(slowest), at(k - width), low) && std::any_of(at(k + width), hull.end(), low);
}

}  // namespace

std::optional<double> peak_frequency(const Curve& curve, double begin, double end,
                                     const std::array<double, 2>& band) {
  const auto inside = std::ranges::count_if(curve.t, [=](double t) { return t >= begin && t <= end; });
  if (inside < 2 || !(end > begin)) return std::nullopt;
  const std::size_t n = std::bit_ceil(static_cast<std::size_t>(inside));
  std::vector<double> y = windowed(curve, begin, end, n);
  constexpr double rounding = 1e-13;
  const auto size = [](double value) { return std::abs(value); };
  if (std::ranges::max(y | std::views::transform(size)) <=
      rounding * std::ranges::max(curve.y | std::views::transform(size)))
    return std::nullopt;
  y.resize(padding * n);
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double>().fwd(spectrum, y);
  const double line = 1 / (static_cast<double>(padding) * (end - begin));  // Hz from one point to the next
  const auto height = [&](std::size_t k) { return std::norm(spectrum[k]); };
  const std::vector<double> hull = without_zeros(y.size() / 2, height);
  constexpr double least = 1e-9;  // of the highest
  const double floor = least * std::ranges::max(hull);
  std::size_t top = 0;
  for (std::size_t k = 2 * padding; k + 1 < y.size() / 2; ++k) {
    const double f = static_cast<double>(k) * line;
    const bool peak = height(k) > height(k - 1) && height(k) >= height(k + 1) && height(k) > floor;
    if (peak && f >= band[0] && f <= band[1] && (top == 0 || height(k) > height(top)) && stands_out(hull, k))
      top = k;
  }
  if (top == 0) return std::nullopt;
  const auto level = [&](std::size_t k) { return std::log(std::max(height(k), 1e-300)); };
  return (static_cast<double>(top) + vertex(level(top - 1), level(top), level(top + 1))) * line;
}

}  // namespace taut
