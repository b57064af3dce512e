#include "engine/layout/material_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/scene/shapes/box.hpp"

namespace taut {
namespace {

constexpr std::size_t most = 4;
using Basis = std::array<double, most>;
using Equations = std::array<std::array<double, most + 1>, most>;

/// `A`: matrix and right side. Returns false if the matrix is singular.
bool solve(Equations& A, std::size_t n) {
  constexpr double least_pivot = 1e-9;
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

Point pitch_on_boundary(const Box& box, double dp, int dim) {
  Point pitch{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
    pitch[k] = (box.high[k] - box.low[k]) / static_cast<double>(box.cells(k, dp));
  return pitch;
}

/// Multilinear weights of the corners of a lattice cell; empty off the lattice.
std::vector<PointWeight> point_in_cell(const std::vector<Point>& x, int begin, int end, const Point& at,
                                       const Body& body, double dp, int dim) {
  constexpr double round_off = 1e-9;
  const Point pitch = pitch_on_boundary(*body.shapes.front().as<Box>(), dp, dim);
  const Point laid = unplaced_point(body, at, dim);
  std::vector<PointWeight> point;
  double sum = 0;
  for (int i = begin; i < end; ++i) {
    const Point of_particle = unplaced_point(body, x[static_cast<std::size_t>(i)], dim);
    double weight = 1;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
      weight *= std::max(0.0, 1 - std::abs(of_particle[k] - laid[k]) / pitch[k]);
    if (weight < round_off) continue;
    point.push_back({i, weight});
    sum += weight;
  }
  if (!(std::abs(sum - 1) < 1e-6)) return {};
  for (PointWeight& w : point) w.weight /= sum;
  return point;
}

double squared_distance(const Point& a, const Point& b) {
  double r2 = 0;
  for (std::size_t k = 0; k < a.size(); ++k) r2 += (a[k] - b[k]) * (a[k] - b[k]);
  return r2;
}

std::vector<int> within_reach(const std::vector<Point>& x, int begin, int end, const Point& at,
                              double reach) {
  std::vector<int> near;
  for (int i = begin; i < end; ++i)
    if (squared_distance(x[i], at) < reach * reach) near.push_back(i);
  return near;
}

int nearest_of(const std::vector<Point>& x, const std::vector<int>& some, const Point& at) {
  return *std::ranges::min_element(some, {}, [&](int i) { return squared_distance(x[i], at); });
}

std::vector<int> linked(const std::vector<Point>& x, const std::vector<int>& some, int first, double link) {
  std::vector<int> found = {first}, left = some;
  std::erase(left, first);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const auto beyond = [&](int i) { return squared_distance(x[i], x[found[k]]) > link * link; };
    const auto reached = std::stable_partition(left.begin(), left.end(), beyond);
    found.insert(found.end(), reached, left.end());
    left.erase(reached, left.end());
  }
  std::ranges::sort(found);
  return found;
}

std::vector<PointWeight> point_of(const std::vector<Point>& x, const std::vector<int>& some, const Point& at,
                                  double reach, int dim) {
  std::vector<Point> places;
  for (const int i : some) places.push_back(x[i]);
  std::vector<PointWeight> point = material_point(places, 0, static_cast<int>(places.size()), at, reach, dim);
  for (PointWeight& w : point) w.particle = some[w.particle];
  return point;
}

template <class Counts>
std::vector<PointWeight> point_of_matching(std::vector<PointWeight> point, std::vector<int> near, int nearest,
                                           const Surroundings& all, const Point& at, const Counts& counts) {
  if (std::ranges::all_of(point, [&](const PointWeight& w) { return counts(w.particle); })) return point;
  std::erase_if(near, [&](int i) { return !counts(i); });
  point = point_of(all.x, linked(all.x, near, nearest, all.link), at, all.reach, all.dim);
  if (point.empty()) point = {{nearest, 1}};
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

std::vector<int> linked_to_nearest(const std::vector<Point>& x, const std::vector<int>& some, const Point& at,
                                   double link) {
  return some.empty() ? some : linked(x, some, nearest_of(x, some, at), link);
}

std::vector<PointWeight> material_point(const std::vector<Point>& x, int begin, int end, const Point& at,
                                        double reach, const Scene& scene, int body) {
  const Body& of = scene.bodies[static_cast<std::size_t>(body)];
  if (of.on_boundary) {
    std::vector<PointWeight> point = point_in_cell(x, begin, end, at, of, scene.spacing, scene.dim);
    if (!point.empty()) return point;
  }
  const std::vector<int> near = within_reach(x, begin, end, at, reach);
  if (near.empty()) return {};
  return point_of(x, linked(x, near, nearest_of(x, near, at), link_of_neighbors * scene.spacing), at, reach,
                  scene.dim);
}

std::vector<PointWeight> point_of_stress(std::vector<PointWeight> point, const Surroundings& all,
                                         const Point& at) {
  std::vector<int> near = within_reach(all.x, all.begin, all.end, at, all.reach);
  std::erase_if(near, [&](int i) { return all.clamped[i] != 0; });
  const bool driven_only = std::ranges::all_of(near, [&](int i) { return all.driven[i] != 0; });
  const auto is_free = [&](int i) { return all.clamped[i] == 0 && (driven_only || all.driven[i] == 0); };
  std::erase_if(near, [&](int i) { return !is_free(i); });
  if (near.empty()) return {};
  const int nearest = nearest_of(all.x, near, at);
  return point_of_matching(std::move(point), std::move(near), nearest, all, at,
                           [&](int i) { return is_free(i) && all.material[i] == all.material[nearest]; });
}

std::vector<PointWeight> point_of_motion(std::vector<PointWeight> point, const Surroundings& all,
                                         const std::vector<int>& motion_group, const Point& at) {
  std::vector<int> near = within_reach(all.x, all.begin, all.end, at, all.reach);
  if (near.empty()) return point;
  const int nearest = nearest_of(all.x, near, at);
  const double least = squared_distance(all.x[nearest], at);
  // equally near particles count: points on the face of a clamp are clamped
  const auto steered = std::ranges::find_if(near, [&](int i) {
    return motion_group[i] != 0 && squared_distance(all.x[i], at) <= least + 1e-6 * all.link * all.link;
  });
  if (steered == near.end())
    return point_of_matching(std::move(point), std::move(near), nearest, all, at,
                             [&](int i) { return all.material[i] == all.material[nearest]; });
  const int first = *steered;
  std::erase_if(near, [&](int i) { return motion_group[i] != motion_group[first]; });
  point = point_of(all.x, linked(all.x, near, first, all.link), at, all.reach, all.dim);
  if (point.empty()) point = {{first, 1}};
  return point;
}

}  // namespace taut
