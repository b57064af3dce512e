#include "engine/diagnostics/indicators.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taut {
namespace {

/// Weight of a patch; small, since sharp creases also cause zigzags.
constexpr double weight_of_patch = 0.2;

constexpr double least_strain = 1e-8;  // times Young's modulus: stress of round-off

}  // namespace

void IndicatorRecord::take(const Reading& now, double time) {
  last = now.share();
  greatest_whole = std::max(greatest_whole, now.whole);
  if (!(now.part > greatest_part)) return;  // or NaN
  greatest_part = now.part;
  at = time;
  particle = now.particle;
}

IndicatorGauge::IndicatorGauge(const Scene& scene, const Snapshot& start, int threads)
    : part_(alternating_part(start, scene.spacing, threads)), spacing_(scene.spacing) {
  row_of_.assign(start.size(), -1);
  first_row_.assign(1, 0);
  for (int row = 0; row < part_.rows(); ++row) {
    const int particle = part_.j[part_.begin[row]];
    row_of_[particle] = row;
    first_row_.resize(static_cast<std::size_t>(start.body[particle]) + 1, row);
  }
  first_row_.push_back(part_.rows());
  for (const Material& each : scene.materials)
    least_stress_ = std::max(least_stress_, least_strain * each.youngs_modulus);
}

Reading IndicatorGauge::hourglass(const std::vector<double>& squared) const {
  Reading worst{0, spacing_};
  double greatest = 0;  // m²
  for (std::size_t body = 0; body + 1 < first_row_.size(); ++body) {
    const auto first = squared.begin() + first_row_[body], end = squared.begin() + first_row_[body + 1];
    if (first != end)
      greatest = std::max(greatest, std::accumulate(first, end, 0.0) / static_cast<double>(end - first));
  }
  constexpr double weight = weight_of_patch * weight_of_patch;  // of squares
  const auto judge_patch = [&](int row) {
    double sum = 0;
    int count = 0;
    for (int k = part_.begin[row]; k < part_.begin[row + 1]; ++k)
      if (const int other = row_of_[part_.j[k]]; other >= 0) sum += squared[other], ++count;
    if (const double mean = weight * sum / count; mean > greatest)
      greatest = mean, worst.particle = part_.j[part_.begin[row]];
  };
  // a patch can be worse than `greatest` only if one of its particles is
  for (int row = 0; row < part_.rows(); ++row) {
    if (weight * squared[row] <= greatest) continue;
    for (int k = part_.begin[row]; k < part_.begin[row + 1]; ++k)
      if (const int other = row_of_[part_.j[k]]; other >= 0) judge_patch(other);
  }
  worst.part = std::sqrt(greatest);
  return worst;
}

Readings IndicatorGauge::operator()(const Snapshot& now) const {
  const auto [squared, alternating, whole] = alternating_sums(part_, now, spacing_);
  const auto rms = [count = std::max(1, part_.rows())](double sum) { return std::sqrt(sum / count); };
  const auto stress = [&](double sum) { return std::max(rms(sum), least_stress_); };
  return {hourglass(squared), Reading{rms(alternating.p), stress(whole.p)},
          Reading{rms(alternating.von_mises), stress(whole.von_mises)}};
}

}  // namespace taut
