#pragma once

#include <cstddef>
#include <vector>

#include "render/gl/solid_painter.hpp"

namespace taut::render {

/// Occlusion test at SolidPainter's samples, 2 × 2 per pixel.
class Cover {
 public:
  /// Takes the plot's size, pixels.
  Cover(int width, int height);

  void clear();
  /// Returns false if in doubt.
  bool hides(const Ball& ball) const;
  void add(const Ball& ball);

 private:
  struct Tiles;
  bool hides(const Tiles& tiles, float front) const;
  void update(const Tiles& tiles);

  int width_, height_;            // samples
  int tile_columns_, tile_rows_;  // squares of samples
  std::vector<float> depth_;      // z of the cover, pixels
  std::vector<float> tile_;       // least depth
};

}  // namespace taut::render
