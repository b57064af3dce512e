#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/image/image.hpp"

namespace taut::render {

/// A sphere as the camera sees it: lengths in pixels.
struct Ball {
  float x, y;  // centre, from the plot's top left corner, downwards
  float z;     // of the centre, towards the camera, from anywhere
  float radius;
  std::uint32_t color;  // bytes R, G, B, 255 in memory
};

/// A corner of a triangle; as of a ball.
struct Corner {
  float x, y, z;
  std::uint32_t color;  // with its light
};

/// Draws what stands in space with OpenGL, the nearest on top. A current context is needed from construction
/// to the last call.
///
/// Light dims a colour by a factor and leaves its hue: colours are data. It comes from behind the camera,
/// upper left, and falls on balls, and on the surface that all drawn things make together, as the depth about
/// a pixel has it; what lies in a hollow of that surface is darker [Luft, Colditz, Deussen: Image enhancement
/// by unsharp masking the depth buffer, 2006].
class SolidPainter {
 public:
  /// Throws UsageError where there is no memory for such a picture.
  SolidPainter(int image_width, int image_height, const Rect& plot, Rgb background = white);

  /// Paints the framebuffer `picture` in the background's colour, and balls and triangles (three corners each)
  /// into the plot.
  void draw(std::uint32_t picture, std::span<const Ball> balls, std::span<const Corner> corners);

 private:
  struct Extent;
  struct Shape {
    std::uint32_t program = 0, vertices = 0, buffer = 0;
    int band_uniform = -1, depth_uniform = -1;
    std::size_t capacity = 0;  // of the buffer, bytes
  };

  void draw_band(int top, int height, int ball_corners, int corners, const Extent& extent);
  void resolve(std::uint32_t picture, int top, int height, int below, const Extent& extent);

  int image_width_, image_height_;
  Rect plot_;
  std::array<float, 3> background_;
  int reach_;        // of the light about a pixel, pixels
  int band_height_;  // the plot is drawn in bands, so that large pictures need no large buffer
  std::uint32_t framebuffer_ = 0, color_ = 0, depth_ = 0;
  Shape ball_, triangle_;
  std::uint32_t resolve_program_ = 0, no_vertices_ = 0;
};

/// What a face keeps of its colour, from its normal of length 1: x to the right, y downwards, z towards the
/// camera.
float light_on(float x, float y, float z);

}  // namespace taut::render
