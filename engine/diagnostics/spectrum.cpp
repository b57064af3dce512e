#include "engine/diagnostics/spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <ranges>
#include <unsupported/Eigen/FFT>
#include <utility>
#include <vector>

namespace taut {
namespace {

constexpr std::size_t padding = 4;

/// `n` evenly spaced samples minus their windowed linear fit, multiplied by the window.
std::vector<double> windowed(const Curve& curve, double begin, double end, std::size_t n) {
  std::vector<double> window(n), y(n);
  double weights = 0, sum = 0, moment = 0, square = 0;  // Σ window · (1, y, s y, s²); s: −1 to 1
  const auto place = [n](std::size_t k) { return 2 * static_cast<double>(k) / static_cast<double>(n) - 1; };
  for (std::size_t k = 0; k < n; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(n);
    window[k] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * share);
    y[k] = value_at(curve, begin + share * (end - begin));
    weights += window[k];
    sum += window[k] * y[k];
    moment += window[k] * place(k) * y[k];
    square += window[k] * place(k) * place(k);
  }
  const double mean = sum / weights,
               slope = square > 0 ? moment / square : 0;  // the window is even about s = 0
  for (std::size_t k = 0; k < n; ++k) y[k] = window[k] * (y[k] - mean - slope * place(k));
  return y;
}

double vertex(double left, double middle, double right) {
  const double bend = left - 2 * middle + right;
  return bend < 0 ? 0.5 * (left - right) / bend : 0;
}

/// Greatest height within 1/(end − begin) of each frequency, to bridge the zeros of the window's spectrum.
template <class Height>
std::vector<double> without_zeros(std::size_t n, const Height& height) {
  std::vector<double> hull(n);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t other = k - std::min(k, padding); other < std::min(k + padding + 1, n); ++other)
      hull[k] = std::max(hull[k], height(other));
  return hull;
}

class Lines {
 public:
  explicit Lines(std::vector<double> hull)
      : hull_(std::move(hull)), below_(hull_.size()), above_(hull_.size()) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (std::size_t k = 0; k < hull_.size(); ++k) {
      if (k >= slowest) least = std::min(least, hull_[k]);
      below_[k] = least;
      most = std::max(most, hull_[k]);
    }
    highest_ = static_cast<std::size_t>(std::ranges::max_element(hull_) - hull_.begin()) + padding;
    floor_ = 1e-9 * most;
    least = std::numeric_limits<double>::infinity();
    for (std::size_t k = hull_.size(); k-- > 0;) above_[k] = least = std::min(least, hull_[k]);
  }

  /// Whether a peak counts as a spectral line (THEORY.md).
  bool have(std::size_t k, double height) const {
    if (height <= floor_ || height <= of_highest(k) || k + width >= hull_.size()) return false;
    if (k <= slowest + width)
      return *std::max_element(hull_.begin(), hull_.begin() + static_cast<std::ptrdiff_t>(k)) <= hull_[k] &&
             hull_[k + width] <= 0.5 * hull_[k];
    return below_[k - width] <= 0.5 * hull_[k] && above_[k + width] <= 0.5 * hull_[k];
  }

  static constexpr std::size_t width = 3 * padding, slowest = 2 * padding;

 private:
  /// Twice the envelope of the side lobes |sin(π d)/(π d (1 − d²))|² of the highest line, d in 1/(end − begin).
  double of_highest(std::size_t k) const {
    const double d = std::abs(static_cast<double>(k) - static_cast<double>(highest_)) / padding;
    if (d <= 2) return 0;
    const double near = d - 0.5, side = 1 / (std::numbers::pi * near * (near * near - 1));
    return 2 * side * side * hull_[highest_];
  }

  std::vector<double> hull_, below_, above_;
  std::size_t highest_ = 0;
  double floor_ = 0;
};

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
  const double line = 1 / (static_cast<double>(padding) * (end - begin));  // Hz
  const auto height = [&](std::size_t k) { return std::norm(spectrum[k]); };
  const Lines lines(without_zeros(y.size() / 2, height));
  std::size_t top = 0;
  for (std::size_t k = Lines::slowest; k + 1 < y.size() / 2; ++k) {
    const double f = static_cast<double>(k) * line;
    const bool peak = height(k) > height(k - 1) && height(k) >= height(k + 1);
    if (peak && f >= band[0] && f <= band[1] && (top == 0 || height(k) > height(top)) &&
        lines.have(k, height(k)))
      top = k;
  }
  if (top == 0) return std::nullopt;
  const auto level = [&](std::size_t k) { return std::log(std::max(height(k), 1e-300)); };
  return (static_cast<double>(top) + vertex(level(top - 1), level(top), level(top + 1))) * line;
}

}  // namespace taut
