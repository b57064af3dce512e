#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/frame_view.hpp"
#include "render/camera.hpp"
#include "render/cover.hpp"
#include "render/gl/solid_painter.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

/// The particles of a frame as they stand in a picture.
class Solids {
 public:
  /// Round particles are `glyph` times as large as they are.
  explicit Solids(const PageLayout& layout, double glyph = 1)
      : layout_(layout), glyph_(glyph), cover_(layout.plot.width, layout.plot.height) {}

  /// Spheres of the particles' size. Those that others hide are left out.
  void place_balls(const FrameView& frame, const Projection& projection,
                   std::span<const std::uint32_t> colors);
  /// The faces of their cells that look at the camera, lit.
  void place_boxes(const FrameView& frame, const Projection& projection,
                   std::span<const std::uint32_t> colors);
  /// Beside these, lines on the faces of walls in 3D, of `color`, where a particle does not hide them.
  void place_walls(const FrameView& frame, const Projection& projection, std::uint32_t color);
  /// The cells of a frame in 2D.
  void place_parallelograms(const FrameView& frame, std::span<const std::uint32_t> colors);

  /// Numbers of the particles that reach into the picture, hidden ones too.
  std::span<const std::size_t> placed() const { return placed_; }
  std::span<const Ball> balls() const { return balls_; }
  std::span<const Corner> corners() const { return corners_; }

 private:
  bool in_picture(double x, double y, double reach) const;
  void clear();
  void drop_hidden();
  void sort_roughly();
  void add_line(const Vector& from, const Vector& to, const Projection& projection, std::uint32_t color);
  void add_face(const Vector& centre, const Vector& a, const Vector& b, std::uint32_t color);

  PageLayout layout_;
  double glyph_;
  std::vector<std::size_t> placed_;
  std::vector<Ball> balls_;
  std::vector<Corner> corners_;
  Cover cover_;
};

/// Radius, in pixels, that a round particle is drawn with.
///
/// A gap narrower than a pixel cannot be drawn: it comes out as moiré and washes the colour out. So a
/// particle grows, by less than 0.7 pixel, until at a diameter of 2 pixels it fills the square about it.
double drawn_radius(double radius);

}  // namespace taut::render
