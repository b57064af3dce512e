#pragma once

#include <array>

#include "render/page/page_layout.hpp"

namespace taut::render {

/// In space: m, or of no unit.
using Vector = std::array<double, 3>;

/// From where a scene in 3D is seen. What is seen is a View in the plane of the picture, to the right and up
/// from the scene's origin.
struct Camera {
  Vector from = {1, -2, 1};  // towards the camera, of any length
  Vector up = {0, 0, 1};     // upwards in the picture, of any length; along `from`: y, or x, instead
  double field_of_view = 0;  // of the view's height, degrees; 0: parallel
  double front = 0;  // where lengths are true when it is not: the plane at this height along `from`, m
  bool operator==(const Camera&) const = default;
};

inline constexpr double greatest_field_of_view = 120;  // degrees

/// Of length 1 and at right angles: to the right and up in the picture, and towards the camera.
struct CameraAxes {
  Vector right, up, back;
};

CameraAxes axes_of(const Camera& camera);
/// The camera gone about what it looks at: to the right about the direction that is up in the scene, then
/// upwards about what is to the right in the picture; degrees.
Camera orbited(const Camera& camera, double right, double upwards);
AxesMarker marker_of(const Camera& camera);

double dot(const Vector& a, const Vector& b);
Vector cross(const Vector& a, const Vector& b);

/// Places of the scene in the plane of the picture.
class Projection {
 public:
  Projection(const Camera& camera, const View& view);

  /// Right, up and towards the camera, m, where lengths are as they are seen: `scale` times the true ones.
  struct Seen {
    Vector at;
    double scale;  // not positive: behind the camera
  };
  Seen operator()(const Vector& x) const;
  /// A short way from `x`, as it is seen.
  Vector way(const Vector& way, const Seen& from) const;

 private:
  CameraAxes axes_;
  double middle_x_, middle_y_;  // of the view, m
  double front_, distance_;     // of the camera from the front, m; 0: parallel
};

}  // namespace taut::render
