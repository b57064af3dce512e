#include "engine/diagnostics/indicators.hpp"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

constexpr double least_strain = 1e-8;  // strain of round-off: times Young's modulus, a stress

}  // namespace

void IndicatorRecord::take(const Reading& now, double time) {
  last = now.share();
  greatest_whole = std::max(greatest_whole, now.whole);
  if (!(now.part > greatest_part)) return;  // or NaN
  greatest_part = now.part;
  at = time;
}

IndicatorGauge::IndicatorGauge(const Scene& scene, const Snapshot& start, int threads)
    : part_(alternating_part(start, scene.spacing, threads)), spacing_(scene.spacing) {
  for (const Material& each : scene.materials)
    least_stress_ = std::max(least_stress_, least_strain * each.youngs_modulus);
}

Readings IndicatorGauge::operator()(const Snapshot& now) const {
  const auto [alternating, whole] = alternating_sums(part_, now, spacing_);
  const auto rms = [count = std::max(1, part_.rows())](double sum) { return std::sqrt(sum / count); };
  const auto stress = [&](double sum) { return std::max(rms(sum), least_stress_); };
  return {Reading{rms(alternating.x), spacing_}, Reading{rms(alternating.p), stress(whole.p)},
          Reading{rms(alternating.von_mises), stress(whole.von_mises)}};
}

}  // namespace taut
