#include "engine/diagnostics/balance.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "engine/core/kernels_of.hpp"
#include "engine/diagnostics/kernels.hpp"

namespace taut {

Balance balance(const Snapshot& now, const Scene& scene) {
  std::vector<StrainDivisors> divisors;
  for (const Material& material : scene.materials)
    divisors.push_back({2 * material.bulk_modulus(), 4 * material.shear_modulus()});
  double out[10];
  best_kernels<SharedKernels::history_row, HistoryKernels>(now.dim).balance(view_of(now), divisors.data(),
                                                                            now.contact_energy, out);
  return {
      out[0],     out[1],      {out[4], out[5], out[6]}, {out[7], out[8], out[9]}, out[2], out[3], now.work,
      now.damped, now.of_walls};
}

double energy_of_rounding(const Scene& scene, const Snapshot& start) {
  double c2 = 0;  // m²/s²
  for (const Material& material : scene.materials)
    c2 = std::max(c2, material.bulk_modulus() / material.density);
  constexpr double rounding = 1e-16;  // (speed / c0)²
  return rounding * c2 * std::accumulate(start.m.begin(), start.m.end(), 0.0);
}

}  // namespace taut
