#pragma once

#include <cstdint>
#include <span>

#include "render/image/image.hpp"

namespace taut::render {

/// A round particle in a plot.
struct Dot {
  float x, y;           // centre, pixels from the plot's top left corner, downwards
  float radius;         // pixels
  std::uint32_t color;  // bytes R, G, B, 255 in memory
};

/// Draws antialiased discs with OpenGL. A current context is needed from construction to the last call.
///
/// Where discs overlap, a pixel belongs to the disc whose centre is nearest (in radii): neighbours pressed
/// together meet in a straight line, and the order of the particles shows at most where two rims meet.
class DiscPainter {
 public:
  DiscPainter(int image_width, int image_height, const Rect& plot);

  /// Paints framebuffer 0 white and the discs into the plot.
  void draw(std::span<const Dot> discs);

 private:
  void draw_band(int top, int height, int count);

  int image_width_, image_height_;
  Rect plot_;
  int band_height_;  // the plot is drawn in bands, so that large pictures need no large buffer
  std::uint32_t framebuffer_ = 0, program_ = 0, vertices_ = 0, buffer_ = 0;
  int band_uniform_ = -1;
  std::size_t capacity_ = 0;  // of the buffer, bytes
};

}  // namespace taut::render
