#pragma once

#include <array>

#include "render/page/page_layout.hpp"

namespace taut::render {

using Vector = std::array<double, 3>;

/// In 3D, a View lies in the picture plane, relative to the scene's origin.
struct Camera {
  Vector from = {1, -2, 1};  // towards the camera, any length
  Vector up = {0, 0, 1};     // replaced by y or x if parallel to `from`
  double field_of_view = 0;  // vertical, degrees; 0: parallel projection
  double front = 0;          // coordinate along `from` of the plane that perspective draws to scale, m
  bool operator==(const Camera&) const = default;
};

inline constexpr double greatest_field_of_view = 120;

/// `back`: towards the camera.
struct CameraAxes {
  Vector right, up, back;
};

CameraAxes axes_of(const Camera& camera);
/// Angles in degrees: to the right around `up`, then upwards.
Camera orbited(const Camera& camera, double right, double upwards);
AxesMarker marker_of(const Camera& camera);

double dot(const Vector& a, const Vector& b);
Vector cross(const Vector& a, const Vector& b);

class Projection {
 public:
  Projection(const Camera& camera, const View& view);

  /// Coordinates to the right, up and towards the camera, m; the first two are scaled.
  struct Projected {
    Vector at;
    double scale;  // projected / true length; not positive behind the camera
  };
  Projected operator()(const Vector& x) const;
  /// Projects a short vector that begins at the projected point `from`.
  Vector project_vector(const Vector& way, const Projected& from) const;

 private:
  CameraAxes axes_;
  double middle_x_, middle_y_;  // of the view, m
  double front_, distance_;     // Camera::front; distance of this plane from the camera, m; 0: parallel
};

}  // namespace taut::render
