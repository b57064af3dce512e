#include "engine/scene/shapes/round_shapes.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>

#include "engine/scene/aligned_layers.hpp"

namespace taut {
namespace {

/// Points k and n − k have opposite angles to the last bit.
Point on_circle(const Point& centre, double r, long k, long n) {
  const double angle =
      2 * std::numbers::pi * static_cast<double>(2 * k <= n ? k : k - n) / static_cast<double>(n);
  return {centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle), 0};
}

Chain circle(const Point& centre, double r, long n, bool against) {
  Chain chain;
  for (long k = 0; k < n; ++k) chain.push_back(on_circle(centre, r, against ? k : (n - k) % n, n));
  return chain;
}

long number_around(double r, double dp) { return std::max(1L, std::lround(2 * std::numbers::pi * r / dp)); }

/// Particles per layer, from the innermost.
std::vector<long> numbers_of(const Ring& ring, double dp) {
  const long layers = std::max(1L, std::lround((ring.outer - ring.inner) / dp));
  const double thickness = (ring.outer - ring.inner) / static_cast<double>(layers);
  std::vector<long> numbers;
  for (long layer = 0; layer < layers; ++layer) {
    const double r = ring.inner + (static_cast<double>(layer) + 0.5) * thickness;
    numbers.push_back(
        number_around(ring.layout == RoundLayout::aligned ? 0.5 * (ring.inner + ring.outer) : r, dp));
  }
  return numbers;
}

constexpr int sectors = 6;
long layers_of(const Disc& disc, double dp) { return std::max(0L, std::lround(disc.radius / dp - 0.5)); }

void add_layer(std::vector<InitialSite>& sites, const Point& centre, double r, long n, double area,
               long fold) {
  const int first = static_cast<int>(sites.size());
  for (long k = 0; k < n; ++k)
    sites.push_back({on_circle(centre, r, k, n), area / static_cast<double>(n),
                     fold > 1 ? first + static_cast<int>((k + n / fold) % n) : -1});
}

/// Small holes distort the cells of aligned layers.
RoundLayout default_layout_in_3d(double inner, double outer, bool keeps_neighbors) {
  const bool fits = keeps_neighbors && inner >= 0.6 * outer * (1 - 1e-9);
  return fits ? RoundLayout::aligned : RoundLayout::lattice;
}

Bounds bounds_of_ball(const Point& centre, double r) {
  return {{centre[0] - r, centre[1] - r, centre[2] - r}, {centre[0] + r, centre[1] + r, centre[2] + r}};
}

}  // namespace

std::string_view name(RoundLayout layout) {
  constexpr std::array<std::string_view, 3> names = {"aligned", "spaced", "lattice"};
  return names[static_cast<std::size_t>(layout)];
}

bool can_be_aligned(double inner, double outer) { return 3 * inner >= outer; }

double measure_of_ball(int dim, double r) {
  return dim == 2 ? std::numbers::pi * r * r : 4.0 / 3.0 * std::numbers::pi * r * r * r;
}

RoundLayout Disc::default_layout(bool keeps_neighbors) {
  return keeps_neighbors ? RoundLayout::spaced : RoundLayout::lattice;
}

Bounds Disc::bounds() const { return bounds_of_ball(centre, radius); }

bool Disc::holds(const Point& x, int dim, double tolerance) const {
  return distance_between(x, centre, dim) <= radius + tolerance;
}

std::vector<InitialSite> Disc::sites(int dim, double dp) const {
  std::vector<InitialSite> sites;
  if (dim != 2 || layout == RoundLayout::lattice) return sites;
  const long layers = layers_of(*this, dp);
  const double thickness = radius / (static_cast<double>(layers) + 0.5);
  sites.push_back({centre, measure_of_ball(2, 0.5 * thickness), 0});
  for (long k = 1; k <= layers; ++k) {
    const double r = static_cast<double>(k) * thickness;
    add_layer(sites, centre, r, sectors * k, 2 * std::numbers::pi * r * thickness, sectors);
  }
  return sites;
}

std::vector<Chain> Disc::outline(int dim, double dp) const {
  if (dim != 2) return {};
  const long layers = layout == RoundLayout::lattice ? 0 : layers_of(*this, dp);
  return {
      circle(centre, radius, layers > 0 ? sectors * layers : std::max(3L, number_around(radius, dp)), true)};
}

RoundLayout Ring::default_layout(int dim, bool keeps_neighbors) const {
  if (dim == 3) return default_layout_in_3d(inner, outer, keeps_neighbors);
  return keeps_neighbors && can_be_aligned(inner, outer) ? RoundLayout::aligned : RoundLayout::spaced;
}

Bounds Ring::bounds() const { return bounds_of_ball(centre, outer); }

bool Ring::holds(const Point& x, int dim, double tolerance) const {
  const double r = distance_between(x, centre, dim);
  return r >= inner - tolerance && r <= outer + tolerance;
}

std::vector<InitialSite> Ring::sites(int dim, double dp) const {
  if (dim == 3) return layout == RoundLayout::aligned ? aligned_sites(*this, dp) : std::vector<InitialSite>{};
  std::vector<InitialSite> sites;
  if (layout == RoundLayout::lattice) return sites;
  const std::vector<long> numbers = numbers_of(*this, dp);
  const double thickness = (outer - inner) / static_cast<double>(numbers.size());
  const long fold = std::accumulate(numbers.begin(), numbers.end(), 0L, std::gcd<long, long>);
  for (std::size_t layer = 0; layer < numbers.size(); ++layer) {
    const double r = inner + (static_cast<double>(layer) + 0.5) * thickness;
    add_layer(sites, centre, r, numbers[layer], 2 * std::numbers::pi * r * thickness, fold);
  }
  return sites;
}

std::vector<Chain> Ring::outline(int dim, double dp) const {
  if (dim != 2) return {};
  const std::vector<long> numbers = numbers_of(*this, dp);
  std::vector<Chain> chains = {circle(centre, outer, std::max(3L, numbers.back()), true)};
  if (inner > 0) chains.push_back(circle(centre, inner, std::max(3L, numbers.front()), false));
  return chains;
}

FacePatches Ring::patches(double dp) const {
  return layout == RoundLayout::aligned ? aligned_patches(*this, dp) : FacePatches{};
}

RoundLayout Cylinder::default_layout(bool keeps_neighbors) const {
  return default_layout_in_3d(inner, radius, keeps_neighbors);
}

Bounds Cylinder::bounds() const {
  Bounds box;
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = (to[k] - from[k]) / length();
    const double half = radius * std::sqrt(std::max(0.0, 1 - along * along));
    box.low[k] = std::min(from[k], to[k]) - half;
    box.high[k] = std::max(from[k], to[k]) + half;
  }
  return box;
}

bool Cylinder::holds(const Point& x, int, double tolerance) const {
  double along = 0, squared = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    along += (x[k] - from[k]) * (to[k] - from[k]) / length();
    squared += (x[k] - from[k]) * (x[k] - from[k]);
  }
  const double r = std::sqrt(std::max(0.0, squared - along * along));
  return along >= -tolerance && along <= length() + tolerance && r <= radius + tolerance &&
         (inner == 0 || r >= inner - tolerance);
}

double Cylinder::measure(int) const {
  return (measure_of_ball(2, radius) - measure_of_ball(2, inner)) * length();
}

double Cylinder::extent_to_divide(int) const {
  return std::min(length(), inner > 0 ? radius - inner : 2 * radius);
}

std::vector<InitialSite> Cylinder::sites(int, double dp) const {
  return layout == RoundLayout::aligned ? aligned_sites(*this, dp) : std::vector<InitialSite>{};
}

FacePatches Cylinder::patches(double dp) const {
  return layout == RoundLayout::aligned ? aligned_patches(*this, dp) : FacePatches{};
}

}  // namespace taut
