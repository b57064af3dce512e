#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/image/image.hpp"

namespace taut::render {

/// A sphere in picture coordinates, pixels.
struct Ball {
  float x, y;  // centre from the plot's top left corner, y downwards
  float z;     // of the centre, towards the camera, from any origin
  float radius;
  std::uint32_t color;  // bytes R, G, B, 255 in memory
};

/// A corner of a triangle, in the coordinates of Ball.
struct Corner {
  float x, y, z;
  std::uint32_t color;  // including its shading
};

/// Draws spheres and triangles with OpenGL, the nearest on top. Requires a current context throughout its lifetime.
///
/// Shading scales a colour and keeps its hue, since colours are data. The light comes from behind the camera, upper
/// left. It shades each sphere, and the visible surface by the depth around each pixel; hollows are darker [Luft,
/// Colditz, Deussen: Image enhancement by unsharp masking the depth buffer, 2006].
class SolidPainter {
 public:
  /// Throws UsageError if there is no memory for the picture.
  SolidPainter(int image_width, int image_height, const Rect& plot, Rgb background = white);

  /// Fills the framebuffer `picture` with the background, and draws balls and triangles (three corners each) into the
  /// plot.
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
  int reach_;        // radius of the shading around a pixel, pixels
  int band_height_;  // of the bands of the plot, which limit the buffers of large pictures
  std::uint32_t framebuffer_ = 0, color_ = 0, depth_ = 0;
  Shape ball_, triangle_;
  std::uint32_t resolve_program_ = 0, no_vertices_ = 0;
};

/// Factor of a face's colour, from its unit normal: x to the right, y downwards, z towards the camera.
float light_on(float x, float y, float z);

}  // namespace taut::render
