#include "render/smooth_light.hpp"

#include <cmath>

#include "render/gl/solid_painter.hpp"

namespace taut::render {
namespace {

constexpr double alike = 0.8;  // least cosine between normals that are averaged

Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Outward normals; their lengths are twice the areas. Since y points down, the triangles are clockwise.
std::vector<Vector> normals_of(std::span<const Vector> points, std::span<const std::uint32_t> triangles) {
  std::vector<Vector> normals;
  for (std::size_t k = 0; k < triangles.size(); k += 3) {
    const Vector& origin = points[triangles[k]];
    normals.push_back(
        cross(difference(points[triangles[k + 2]], origin), difference(points[triangles[k + 1]], origin)));
  }
  return normals;
}

}  // namespace

std::vector<float> smooth_light(std::span<const Vector> points, std::span<const std::uint32_t> triangles) {
  const std::vector<Vector> normals = normals_of(points, triangles);
  // corners at a point: `corner[k]` for first[point] ≤ k < first[point + 1]
  std::vector<std::size_t> first(points.size() + 2, 0), corner(triangles.size());
  for (const std::uint32_t point : triangles) ++first[point + 2];
  for (std::size_t k = 2; k < first.size(); ++k) first[k] += first[k - 1];
  for (std::size_t k = 0; k < triangles.size(); ++k) corner[first[triangles[k] + 1]++] = k;

  std::vector<float> light(triangles.size(), 1);
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const Vector& own = normals[k / 3];
    const double length = std::sqrt(dot(own, own));
    if (!(length > 0)) continue;
    Vector mean{};
    for (std::size_t c = first[triangles[k]]; c < first[triangles[k] + 1]; ++c) {
      const Vector& other = normals[corner[c] / 3];
      if (!(dot(own, other) > alike * length * std::sqrt(dot(other, other)))) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += other[axis];
    }
    // towards the camera, also for inner sides
    const double scale = (own[2] < 0 ? -1 : 1) / std::sqrt(dot(mean, mean));
    light[k] = light_on(static_cast<float>(scale * mean[0]), static_cast<float>(scale * mean[1]),
                        static_cast<float>(scale * mean[2]));
  }
  return light;
}

}  // namespace taut::render
