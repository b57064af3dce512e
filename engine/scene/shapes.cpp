#include "engine/scene/shapes.hpp"

namespace taut {

std::vector<InitialSite> Ring::sites(int dim, double dp) const {
  std::vector<InitialSite> sites;
  if (dim != 2) return sites;
  const int layers = std::max(1L, std::lround((outer - inner) / dp));
  const double thickness = (outer - inner) / layers;
  for (int layer = 0; layer < layers; ++layer) {
    const double r = inner + (layer + 0.5) * thickness;
    const long n = std::max(1L, std::lround(2 * std::numbers::pi * r / dp));
    const double V0 = 2 * std::numbers::pi * r * thickness / static_cast<double>(n);
    for (long k = 0; k < n; ++k) {
      // angles from −π to π, so that the layer is its own mirror image in y to the last bit
      const double angle =
          2 * std::numbers::pi * static_cast<double>(2 * k <= n ? k : k - n) / static_cast<double>(n);
      sites.push_back({{centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle), 0}, V0});
    }
  }
  return sites;
}

}  // namespace taut
