#include "render/wall_grid.hpp"

#include <algorithm>
#include <cmath>

namespace taut::render {
namespace {

/// Axes in the plane; the first is a projected coordinate axis.
std::pair<Vector, Vector> axes_on(const Vector& normal) {
  const auto least = std::ranges::min_element(normal, {}, [](double n) { return std::abs(n); });
  Vector axis{};
  axis[static_cast<std::size_t>(least - normal.begin())] = 1;
  Vector along = axis;
  for (std::size_t k = 0; k < 3; ++k) along[k] -= dot(axis, normal) * normal[k];
  const double length = std::sqrt(dot(along, along));
  for (double& component : along) component /= length;
  return {along, cross(normal, along)};
}

std::pair<double, double> ends(std::vector<double> x) {
  constexpr double margin = 2;     // cells
  constexpr double farthest = 50;  // cells from the median point; excludes a lost particle
  const auto [low, high] = std::ranges::minmax(x);
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::ranges::nth_element(x, middle);
  return {std::floor(std::max(low - margin, *middle - farthest)),
          std::ceil(std::min(high + margin, *middle + farthest))};
}

}  // namespace

std::vector<std::pair<Vector, Vector>> grid_on(const WallFace& wall, std::span<const Vector> points,
                                               double cell) {
  if (points.empty()) return {};
  const auto [a, b] = axes_on(wall.normal);
  std::vector<double> on_a, on_b;
  for (const Vector& x : points) {
    const Vector d{x[0] - wall.at[0], x[1] - wall.at[1], x[2] - wall.at[2]};
    on_a.push_back(dot(d, a) / cell), on_b.push_back(dot(d, b) / cell);
  }
  const auto [a0, a1] = ends(std::move(on_a));
  const auto [b0, b1] = ends(std::move(on_b));
  constexpr double many = 1e9;  // cells; far beyond, p + 1 would round to p
  for (const double end : {a0, a1, b0, b1})
    if (!(std::abs(end) < many)) return {};
  const auto at = [&](double p, double q) {
    Vector x = wall.at;
    for (std::size_t k = 0; k < 3; ++k) x[k] += cell * (p * a[k] + q * b[k]);
    return x;
  };
  std::vector<std::pair<Vector, Vector>> lines;
  for (double p = a0; p <= a1; ++p) lines.emplace_back(at(p, b0), at(p, b1));
  for (double q = b0; q <= b1; ++q) lines.emplace_back(at(a0, q), at(a1, q));
  return lines;
}

}  // namespace taut::render
