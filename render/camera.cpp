#include "render/camera.hpp"

#include <cmath>
#include <numbers>

namespace taut::render {
namespace {

Vector normalised(const Vector& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

Vector turned(const Vector& a, const Vector& axis, double degrees) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const Vector across = cross(axis, a);
  Vector result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = c * a[k] + s * across[k] + (1 - c) * dot(axis, a) * axis[k];
  return result;
}

}  // namespace

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

CameraAxes axes_of(const Camera& camera) {
  CameraAxes axes;
  axes.back = normalised(camera.from);
  constexpr double least_angle = 1e-6;  // rad; below, `up` counts as parallel
  for (const Vector& up : {camera.up, Vector{0, 1, 0}, Vector{1, 0, 0}}) {
    const Vector right = cross(normalised(up), axes.back);
    if (!(std::sqrt(dot(right, right)) > least_angle)) continue;
    axes.right = normalised(right);
    axes.up = cross(axes.back, axes.right);
    break;
  }
  return axes;
}

Camera orbited(const Camera& camera, double right, double upwards) {
  Camera gone = camera;
  gone.from = turned(camera.from, normalised(camera.up), right);
  gone.from = turned(gone.from, axes_of(gone).right, -upwards);
  return gone;
}

AxesMarker marker_of(const Camera& camera) {
  const auto [right, up, back] = axes_of(camera);
  AxesMarker marker;
  for (std::size_t axis = 0; axis < 3; ++axis) marker[axis] = {right[axis], up[axis], back[axis]};
  return marker;
}

Projection::Projection(const Camera& camera, const View& view)
    : axes_(axes_of(camera)),
      middle_x_(0.5 * (view.x_min + view.x_max)),
      middle_y_(0.5 * (view.y_min + view.y_max)),
      front_(camera.front),
      distance_(camera.field_of_view > 0 ? 0.5 * (view.y_max - view.y_min) /
                                               std::tan(camera.field_of_view * std::numbers::pi / 360)
                                         : 0) {}

Projection::Projected Projection::operator()(const Vector& x) const {
  Projected seen{{dot(axes_.right, x), dot(axes_.up, x), dot(axes_.back, x)}, 1};
  if (distance_ == 0) return seen;
  seen.scale = distance_ / (distance_ + front_ - seen.at[2]);
  seen.at[0] = middle_x_ + (seen.at[0] - middle_x_) * seen.scale;
  seen.at[1] = middle_y_ + (seen.at[1] - middle_y_) * seen.scale;
  return seen;
}

Vector Projection::project_vector(const Vector& way, const Projected& from) const {
  Vector seen{dot(axes_.right, way), dot(axes_.up, way), dot(axes_.back, way)};
  if (distance_ == 0) return seen;
  const double nearer = from.scale / distance_ * seen[2];
  seen[0] = seen[0] * from.scale + (from.at[0] - middle_x_) * nearer;
  seen[1] = seen[1] * from.scale + (from.at[1] - middle_y_) * nearer;
  return seen;
}

}  // namespace taut::render
