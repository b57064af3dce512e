#include "engine/scene/shapes/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Dense>

namespace taut {
namespace {

Eigen::Vector3d eigen_vector(const Point& x) { return Eigen::Vector3d(x.data()); }

double volume_of(const Triangles& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.corners)
    volume += eigen_vector(mesh.points[static_cast<std::size_t>(a)])
                  .dot(eigen_vector(mesh.points[static_cast<std::size_t>(b)])
                           .cross(eigen_vector(mesh.points[static_cast<std::size_t>(c)]))) /
              6;
  return volume;
}

/// Side of the line ab, seen from +z, on which x + (ε, ε²) lies: 1 is left, -1 right; 0 if a and b coincide.
/// Simulation of simplicity (Edelsbrunner, Mücke 1990).
int side_of(const Point& x, const Point& a, const Point& b) {
  if (std::pair(b[0], b[1]) < std::pair(a[0], a[1])) return -side_of(x, b, a);
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  const double turn = dx * (x[1] - a[1]) - dy * (x[0] - a[0]);
  for (const double sign : {turn, -dy, dx})
    if (sign != 0) return sign > 0 ? 1 : -1;
  return 0;
}

double squared_distance_to_edge(const Eigen::Vector3d& x, const Eigen::Vector3d& a,
                                const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0 ? std::clamp((x - a).dot(along) / length2, 0.0, 1.0) : 0;
  return (x - a - share * along).squaredNorm();
}

double squared_distance_to_triangle(const Point& place, const std::array<Point, 3>& corner) {
  const Eigen::Vector3d x = eigen_vector(place), a = eigen_vector(corner[0]), b = eigen_vector(corner[1]),
                        c = eigen_vector(corner[2]);
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const auto is_left = [&](const auto& from, const auto& to) {
    return normal.dot((to - from).cross(x - from)) >= 0;
  };
  const double area2 = normal.squaredNorm();
  if (area2 > 0 && is_left(a, b) && is_left(b, c) && is_left(c, a))
    return std::pow(normal.dot(x - a), 2) / area2;
  return std::min({squared_distance_to_edge(x, a, b), squared_distance_to_edge(x, b, c),
                   squared_distance_to_edge(x, c, a)});
}

std::array<Point, 3> corners_of_triangle(const Triangles& mesh, int triangle) {
  std::array<Point, 3> all;
  for (std::size_t k = 0; k < 3; ++k)
    all[k] = mesh.points[static_cast<std::size_t>(mesh.corners[static_cast<std::size_t>(triangle)][k])];
  return all;
}

Bounds bounds_of(std::span<const Point> points) {
  Bounds box{points.front(), points.front()};
  for (const Point& x : points) box = joined(box, {x, x});
  return box;
}

}  // namespace

MeshFaults faults_of(const Triangles& mesh) {
  std::map<std::pair<int, int>, std::pair<int, int>> uses;
  for (const auto& corner : mesh.corners)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = corner[k], b = corner[(k + 1) % 3];
      auto& [there, back] = uses[std::minmax(a, b)];
      ++(a < b ? there : back);
    }
  MeshFaults faults;
  for (const auto& [edge, use] : uses) {
    const bool is_open = (use.first + use.second) % 2 != 0;
    faults.open += is_open;
    faults.turned += !is_open && use.first != use.second;
  }
  return faults;
}

Mesh::Mesh(Triangles mesh) : mesh_(std::move(mesh)), box_(bounds_of(mesh_.points)) {
  volume_ = std::abs(volume_of(mesh_));
  const double most = std::sqrt(static_cast<double>(mesh_.corners.size()));
  const double width = box_.high[0] - box_.low[0], depth = box_.high[1] - box_.low[1];
  const double ratio = width > 0 && depth > 0 ? std::sqrt(width / depth) : 1;
  sides_ = {static_cast<int>(std::clamp(most * ratio, 1.0, 4096.0)),
            static_cast<int>(std::clamp(most / ratio, 1.0, 4096.0))};
  triangles_.resize(static_cast<std::size_t>(sides_[0]) * static_cast<std::size_t>(sides_[1]));
  for (std::size_t k = 0; k < mesh_.corners.size(); ++k) {
    const Bounds box = bounds_of(corners_of_triangle(mesh_, static_cast<int>(k)));
    const Range across = cells(0, box.low[0], box.high[0]), along = cells(1, box.low[1], box.high[1]);
    for (int j = along[0]; j <= along[1]; ++j)
      for (int i = across[0]; i <= across[1]; ++i)
        triangles_[static_cast<std::size_t>(j * sides_[0] + i)].push_back(static_cast<int>(k));
  }
}

Bounds Mesh::bounds() const {
  Bounds box = box_;
  for (std::size_t k = 0; k < 3; ++k) box.low[k] += from_[k], box.high[k] += from_[k];
  return box;
}

Mesh::Range Mesh::cells(std::size_t axis, double low, double high) const {
  const double side = (box_.high[axis] - box_.low[axis]) / sides_[axis];
  const auto cell = [&](double x) {
    const double number = side > 0 ? (x - box_.low[axis]) / side : 0;
    return static_cast<int>(std::clamp(number, 0.0, sides_[axis] - 1.0));
  };
  return {cell(low), cell(high)};
}

template <class Visit>
void Mesh::visit_near(const Point& x, double distance, const Visit& visit) const {
  const Range across = cells(0, x[0] - distance, x[0] + distance),
              along = cells(1, x[1] - distance, x[1] + distance);
  for (int j = along[0]; j <= along[1]; ++j)
    for (int i = across[0]; i <= across[1]; ++i)
      for (const int triangle : triangles_[static_cast<std::size_t>(j * sides_[0] + i)]) visit(triangle);
}

int Mesh::winding_number(const Point& x) const {
  if (x[0] < box_.low[0] || x[0] > box_.high[0] || x[1] < box_.low[1] || x[1] > box_.high[1]) return 0;
  int number = 0;
  visit_near(x, 0, [&](int triangle) {
    const auto [a, b, c] = corners_of_triangle(mesh_, triangle);
    const int side = side_of(x, a, b);
    if (side == 0 || side != side_of(x, b, c) || side != side_of(x, c, a)) return;
    const Eigen::Vector3d normal =
        (eigen_vector(b) - eigen_vector(a)).cross(eigen_vector(c) - eigen_vector(a));
    const double above = normal.dot(eigen_vector(a) - eigen_vector(x)) * (normal[2] > 0 ? 1 : -1);
    if (normal[2] != 0 && above > 0) number += side;
  });
  return number;
}

bool Mesh::is_within(double distance, const Point& x) const {
  bool found = false;
  visit_near(x, distance, [&](int triangle) {
    found =
        found || squared_distance_to_triangle(x, corners_of_triangle(mesh_, triangle)) <= distance * distance;
  });
  return found;
}

bool Mesh::holds(const Point& place, int, double tolerance) const {
  Point x = place;
  for (std::size_t k = 0; k < 3; ++k) x[k] -= from_[k];
  const bool inside = winding_number(x) != 0;
  if (tolerance == 0 || inside == (tolerance > 0)) return inside;
  return is_within(std::abs(tolerance), x) == (tolerance > 0);
}

}  // namespace taut
