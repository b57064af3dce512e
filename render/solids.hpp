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

class Solids {
 public:
  explicit Solids(const PageLayout& layout, double glyph = 1)
      : layout_(layout), glyph_(glyph), cover_(layout.plot.width, layout.plot.height) {}

  /// May omit hidden spheres.
  void place_balls(const FrameView& frame, const Projection& projection,
                   std::span<const std::uint32_t> colors);
  void place_boxes(const FrameView& frame, const Projection& projection,
                   std::span<const std::uint32_t> colors);
  /// Adds grid lines.
  void place_walls(const FrameView& frame, const Projection& projection, std::uint32_t color);
  /// Loose particles become balls. `places`: `SurfaceCorner::place` of each point; if `uniform`, a triangle takes the
  /// place of its first point. No `projection` in 2D.
  void place_surface(const FrameView& frame, const Projection* projection, std::span<const float> places,
                     std::span<const std::uint32_t> colors, bool uniform);
  /// Places 2D cells.
  void place_parallelograms(const FrameView& frame, std::span<const std::uint32_t> colors);

  /// Particles in the picture, including hidden ones.
  std::span<const std::size_t> placed() const { return placed_; }
  std::span<const Ball> balls() const { return balls_; }
  std::span<const Corner> corners() const { return corners_; }
  std::span<const SurfaceCorner> surface() const { return surface_; }

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
  std::vector<SurfaceCorner> surface_;
  Cover cover_;
};

/// In pixels. Small radii grow, since gaps narrower than a pixel cause moiré.
double drawn_radius(double radius);

}  // namespace taut::render
