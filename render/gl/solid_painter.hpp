#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/image/image.hpp"

namespace taut::render {

struct Ball {
  float x, y;  // from the plot's top left, y downwards
  float z;     // towards the camera
  float radius;
  std::uint32_t color;  // bytes R, G, B, 255
};

struct Corner {
  float x, y, z;
  std::uint32_t color;
};

/// Draws spheres and triangles with OpenGL. Requires a current context throughout its lifetime. The depths around
/// each pixel make hollows darker [Luft, Colditz, Deussen: Image enhancement by unsharp masking the depth buffer,
/// 2006].
class SolidPainter {
 public:
  /// Throws UsageError without enough memory.
  SolidPainter(int image_width, int image_height, const Rect& plot, Rgb background = white);

  /// Fills the framebuffer with the background, and draws balls and triangles (three corners each).
  void draw(std::uint32_t picture, std::span<const Ball> balls, std::span<const Corner> corners);

 private:
  struct Extent;
  struct Shape {
    std::uint32_t program = 0, vertices = 0, buffer = 0;
    int band_uniform = -1, depth_uniform = -1;
    std::size_t capacity = 0;  // bytes
  };

  void draw_band(int top, int height, int ball_corners, int corners, const Extent& extent);
  void resolve(std::uint32_t picture, int top, int height, int below, const Extent& extent);

  int image_width_, image_height_;
  Rect plot_;
  std::array<float, 3> background_;
  int reach_;  // pixels
  int band_height_;
  std::uint32_t framebuffer_ = 0, color_ = 0, depth_ = 0;
  Shape ball_, triangle_;
  std::uint32_t resolve_program_ = 0, no_vertices_ = 0;
};

/// Colour factor of a unit normal: x to the right, y downwards, z towards the camera.
float light_on(float x, float y, float z);

}  // namespace taut::render
