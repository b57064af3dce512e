#include "engine/diagnostics/balance.hpp"

#include <algorithm>
#include <numeric>

#include "engine/diagnostics/history_sums.hpp"

namespace taut {

Balance balance(const Snapshot& now, const Scene& scene) { return sums_of(now, scene); }

double energy_of_rounding(const Scene& scene, const Snapshot& start) {
  double c2 = 0;  // m²/s²
  for (const Material& material : scene.materials)
    c2 = std::max(c2, material.bulk_modulus() / material.density);
  constexpr double rounding = 1e-16;  // of speeds, over the sound speed, squared
  return rounding * c2 * std::accumulate(start.m.begin(), start.m.end(), 0.0);
}

}  // namespace taut
