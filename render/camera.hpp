#pragma once

#include <array>

#include "render/page/page_layout.hpp"

namespace taut::render {

/// A vector in space, m or dimensionless.
using Vector = std::array<double, 3>;

/// Viewpoint of a 3D scene. A View selects the visible part of the picture plane, from the scene's origin.
struct Camera {
  Vector from = {1, -2, 1};  // direction towards the camera, of any length
  Vector up = {0, 0, 1};  // upwards in the picture, of any length; if parallel to `from`, y or x replaces it
  double field_of_view = 0;  // vertical, degrees; 0: parallel projection
  double front = 0;          // perspective: height along `from` of the plane with true lengths, m
  bool operator==(const Camera&) const = default;
};

inline constexpr double greatest_field_of_view = 120;  // degrees

/// Orthonormal axes: to the right and up in the picture, and towards the camera.
struct CameraAxes {
  Vector right, up, back;
};

CameraAxes axes_of(const Camera& camera);
/// Orbits the camera around the scene: first to the right around `up`, then upwards around the picture's
/// horizontal axis; degrees.
Camera orbited(const Camera& camera, double right, double upwards);
AxesMarker marker_of(const Camera& camera);

double dot(const Vector& a, const Vector& b);
Vector cross(const Vector& a, const Vector& b);

/// Projects points onto the picture plane.
class Projection {
 public:
  Projection(const Camera& camera, const View& view);

  /// Coordinates to the right, up and towards the camera, m. Right and up are scaled by `scale`.
  struct Seen {
    Vector at;
    double scale;  // ratio of projected to true length; not positive: behind the camera
  };
  Seen operator()(const Vector& x) const;
  /// Projects a short vector that starts at `from`.
  Vector way(const Vector& way, const Seen& from) const;

 private:
  CameraAxes axes_;
  double middle_x_, middle_y_;  // centre of the view, m
  double front_, distance_;     // front: as in Camera; distance: camera to front plane, m; 0: parallel
};

}  // namespace taut::render
