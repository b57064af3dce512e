#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/image/image.hpp"

namespace taut::render {

struct Ball {
  float x, y;  // pixels from the plot's top left, y downwards
  float z;     // pixels towards the camera
  float radius;
  std::uint32_t color;  // bytes R, G, B, 255
};

struct Corner {
  float x, y, z;  // as in Ball
  std::uint32_t color;
};

struct SurfaceCorner {
  float x, y, z;  // as in Ball
  float place;    // among the colours, clamped to 0 to 1; below −1000: NaN
  float light;    // colour factor
};

struct SolidParts {
  std::span<const Ball> balls{};
  std::span<const Corner> corners{};         // three per triangle
  std::span<const SurfaceCorner> surface{};  // three per triangle
  std::span<const std::uint32_t> palette{};  // of the surface; the last is for NaN
};

/// Darkens hollows [Luft, Colditz, Deussen: Image enhancement by unsharp masking the depth buffer, 2006].
/// Constructor and `draw` require the same current context.
class SolidPainter {
 public:
  /// Throws UsageError without enough memory.
  SolidPainter(int image_width, int image_height, const Rect& plot, Rgb background = white,
               bool transparent = false);

  /// Fills the framebuffer `picture` with the background first. Surfaces interpolate values, not colours.
  void draw(std::uint32_t picture, const SolidParts& parts);

 private:
  struct Extent;
  struct Shape {
    std::uint32_t program = 0, vertices = 0, buffer = 0;
    int band_uniform = -1, depth_uniform = -1;
    std::size_t capacity = 0;  // bytes
    int count = 0;             // corners
  };

  void draw_band(int top, int height, const Extent& extent);
  void resolve(std::uint32_t picture, int top, int height, int below, const Extent& extent);

  int image_width_, image_height_;
  Rect plot_;
  std::array<float, 3> background_;  // all 0 if transparent
  float opacity_;
  int reach_;        // radius of the shading, pixels
  int band_height_;  // pixels
  std::uint32_t framebuffer_ = 0, color_ = 0, depth_ = 0;
  Shape ball_, triangle_, surface_;
  std::uint32_t palette_ = 0;
  std::uint32_t resolve_program_ = 0, no_vertices_ = 0;
};

/// Light on a face with this unit normal: x to the right, y downwards, z towards the camera.
float light_on(float x, float y, float z);

}  // namespace taut::render
