#include "engine/scene/shapes.hpp"

#include <array>
#include <numeric>

namespace taut {
namespace {

/// `n` particles on the circle of this radius, which stand for an area of `area`, m². All are turned onto
/// each other by `fold` turns of a circle.
void add_layer(std::vector<InitialSite>& sites, const Point& centre, double r, long n, double area,
               long fold) {
  const int first = static_cast<int>(sites.size());
  for (long k = 0; k < n; ++k) {
    // angles from −π to π, so that the layer is its own mirror image in y to the last bit
    const double angle =
        2 * std::numbers::pi * static_cast<double>(2 * k <= n ? k : k - n) / static_cast<double>(n);
    sites.push_back({{centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle), 0},
                     area / static_cast<double>(n),
                     fold > 1 ? first + static_cast<int>((k + n / fold) % n) : -1});
  }
}

}  // namespace

std::string_view name(RoundLayout layout) {
  constexpr std::array<std::string_view, 3> names = {"aligned", "spaced", "lattice"};
  return names[static_cast<std::size_t>(layout)];
}

std::vector<InitialSite> Disc::sites(int dim, double dp) const {
  std::vector<InitialSite> sites;
  if (dim != 2 || layout == RoundLayout::lattice) return sites;
  constexpr int sectors = 6;
  const long layers = std::max(0L, std::lround(radius / dp - 0.5));
  const double thickness = radius / (static_cast<double>(layers) + 0.5);
  sites.push_back({centre, measure_of_ball(2, 0.5 * thickness), 0});
  for (long k = 1; k <= layers; ++k) {
    const double r = static_cast<double>(k) * thickness;
    add_layer(sites, centre, r, sectors * k, 2 * std::numbers::pi * r * thickness, sectors);
  }
  return sites;
}

std::vector<InitialSite> Ring::sites(int dim, double dp) const {
  std::vector<InitialSite> sites;
  if (dim != 2 || layout == RoundLayout::lattice) return sites;
  const int layers = std::max(1L, std::lround((outer - inner) / dp));
  const double thickness = (outer - inner) / layers;
  const auto radius = [&](int layer) { return inner + (layer + 0.5) * thickness; };
  std::vector<long> numbers;
  long fold = 0;
  for (int layer = 0; layer < layers; ++layer) {
    const double r = layout == RoundLayout::aligned ? 0.5 * (inner + outer) : radius(layer);
    numbers.push_back(std::max(1L, std::lround(2 * std::numbers::pi * r / dp)));
    fold = std::gcd(fold, numbers.back());
  }
  for (int layer = 0; layer < layers; ++layer) {
    const double r = radius(layer);
    add_layer(sites, centre, r, numbers[static_cast<std::size_t>(layer)],
              2 * std::numbers::pi * r * thickness, fold);
  }
  return sites;
}

}  // namespace taut
