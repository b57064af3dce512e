#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace taut::render {

/// Pixels from the top left.
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
};

using Rgb = std::array<std::uint8_t, 3>;
inline constexpr Rgb white = {255, 255, 255};

/// Whether black is easier to read on `color` than white; ITU-R BT.709 on stored values.
inline bool is_light(Rgb color) { return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2] > 118; }

/// Rows from the top. A pixel has the bytes B, G, R, 255 for OSMesa and Cairo. If transparent, the last byte is the
/// opacity, which multiplies the others.
struct Image {
  int width = 0;
  int height = 0;
  bool transparent = false;
  std::vector<std::uint8_t> pixels;

  Image() = default;
  Image(int width_, int height_)
      : width(width_), height(height_), pixels(static_cast<std::size_t>(width_) * height_ * 4, 255) {}

  std::size_t offset(int column, int row) const {
    return (static_cast<std::size_t>(row) * width + column) * 4;
  }
  Rgb at(int column, int row) const {
    const std::uint8_t* p = &pixels[offset(column, row)];
    return {p[2], p[1], p[0]};
  }
  void set(int column, int row, Rgb color) {
    std::uint8_t* p = &pixels[offset(column, row)];
    p[0] = color[2], p[1] = color[1], p[2] = color[0], p[3] = 255;
  }
  void fill(Rgb color) {
    if (transparent) return pixels.assign(pixels.size(), 0);
    for (std::size_t k = 0; k < pixels.size(); k += 4)
      pixels[k] = color[2], pixels[k + 1] = color[1], pixels[k + 2] = color[0], pixels[k + 3] = 255;
  }
  bool operator==(const Image&) const = default;
};

}  // namespace taut::render
