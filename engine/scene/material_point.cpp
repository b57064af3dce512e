#include "engine/scene/material_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

namespace taut {
namespace {

constexpr std::size_t most = 4;  // 1 and three components
using Basis = std::array<double, most>;
using Equations = std::array<std::array<double, most + 1>, most>;

/// Solves for the right side in the last column; false if the matrix is singular.
bool solve(Equations& A, std::size_t n) {
  constexpr double least_pivot = 1e-9;  // of the matrix's weights: a line of particles has none across it
  const double scale = A[0][0];
  for (std::size_t k = 0; k < n; ++k) {
    if (!(std::abs(A[k][k]) > least_pivot * scale)) return false;
    for (std::size_t row = 0; row < n; ++row) {
      if (row == k) continue;
      const double factor = A[row][k] / A[k][k];
      for (std::size_t l = k; l <= n; ++l) A[row][l] -= factor * A[k][l];
    }
  }
  return true;
}

/// Distances of particles on a box's faces, m.
Point pitch_on_boundary(const Box& box, double dp, int dim) {
  Point pitch{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
    pitch[k] = (box.high[k] - box.low[k]) / static_cast<double>(box.cells(k, dp));
  return pitch;
}

/// Products of hats; empty where the particles are no lattice of this pitch around the point.
std::vector<PointWeight> point_in_cell(const std::vector<Point>& x, int begin, int end, const Point& at,
                                       const Point& pitch, int dim) {
  constexpr double round_off = 1e-9;
  std::vector<PointWeight> point;
  double sum = 0;
  for (int i = begin; i < end; ++i) {
    double weight = 1;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
      weight *= std::max(0.0, 1 - std::abs(x[static_cast<std::size_t>(i)][k] - at[k]) / pitch[k]);
    if (weight < round_off) continue;
    point.push_back({i, weight});
    sum += weight;
  }
  if (!(std::abs(sum - 1) < 1e-6)) return {};
  for (PointWeight& w : point) w.weight /= sum;
  return point;
}

}  // namespace

std::vector<PointWeight> material_point(const std::vector<Point>& x, int begin, int end, const Point& at,
                                        double reach, int dim) {
  const std::size_t n = static_cast<std::size_t>(dim) + 1;
  Equations A{};
  std::vector<PointWeight> point;
  std::vector<Basis> bases;
  for (int i = begin; i < end; ++i) {
    Basis b{1};
    double r2 = 0;
    for (std::size_t k = 1; k < n; ++k) {
      b[k] = (x[static_cast<std::size_t>(i)][k - 1] - at[k - 1]) / reach;
      r2 += b[k] * b[k];
    }
    if (r2 >= 1) continue;
    const double w = (1 - r2) * (1 - r2);
    point.push_back({i, w});
    bases.push_back(b);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t l = 0; l < n; ++l) A[k][l] += w * b[k] * b[l];
  }
  A[0][n] = 1;
  if (point.size() < n || !solve(A, n)) return {};
  for (std::size_t p = 0; p < point.size(); ++p) {
    double shape = 0;
    for (std::size_t k = 0; k < n; ++k) shape += bases[p][k] * A[k][n] / A[k][k];
    point[p].weight *= shape;
  }
  return point;
}

std::vector<PointWeight> material_point(const std::vector<Point>& x, int begin, int end, const Point& at,
                                        double reach, const Scene& scene, int body) {
  const Body& of = scene.bodies[static_cast<std::size_t>(body)];
  if (of.on_boundary) {
    const Point pitch = pitch_on_boundary(std::get<Box>(of.shapes.front()), scene.spacing, scene.dim);
    std::vector<PointWeight> point = point_in_cell(x, begin, end, at, pitch, scene.dim);
    if (!point.empty()) return point;
  }
  return material_point(x, begin, end, at, reach, scene.dim);
}

FreeParticles::FreeParticles(const std::vector<Point>& all, const std::vector<unsigned char>& held, int begin,
                             int end) {
  for (int i = begin; i < end; ++i) {
    if (held[i]) continue;
    id.push_back(i);
    x.push_back(all[i]);
  }
}

std::vector<PointWeight> point_of_stress(std::vector<PointWeight> point,
                                         const std::vector<unsigned char>& held, const FreeParticles& free,
                                         const Point& at, double reach, int dim) {
  if (std::ranges::none_of(point, [&](const PointWeight& w) { return held[w.particle] != 0; })) return point;
  point = material_point(free.x, 0, static_cast<int>(free.x.size()), at, reach, dim);
  for (PointWeight& w : point) w.particle = free.id[w.particle];
  return point;
}

}  // namespace taut
