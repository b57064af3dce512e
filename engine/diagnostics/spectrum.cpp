#include "engine/diagnostics/spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
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

}  // namespace

std::optional<double> peak_frequency(const Curve& curve, double begin, double end,
                                     const std::array<double, 2>& band) {
  const auto inside = std::ranges::count_if(curve.t, [=](double t) { return t >= begin && t <= end; });
  if (inside < 2 || !(end > begin)) return std::nullopt;
  const std::size_t n = std::bit_ceil(static_cast<std::size_t>(inside));
  std::vector<double> y = windowed(curve, begin, end, n);
  y.resize(padding * n);
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double>().fwd(spectrum, y);
  const double line = 1 / (static_cast<double>(padding) * (end - begin));  // Hz from one point to the next
  const auto height = [&](std::size_t k) { return std::norm(spectrum[k]); };
  std::size_t top = 0;
  for (std::size_t k = 1; k + 1 < y.size() / 2; ++k) {
    const double f = static_cast<double>(k) * line;
    const bool peak = height(k) > height(k - 1) && height(k) >= height(k + 1);
    if (peak && f >= band[0] && f <= band[1] && (top == 0 || height(k) > height(top))) top = k;
  }
  if (top == 0) return std::nullopt;
  const auto level = [&](std::size_t k) { return std::log(std::max(height(k), 1e-300)); };
  return (static_cast<double>(top) + vertex(level(top - 1), level(top), level(top + 1))) * line;
}

}  // namespace taut
