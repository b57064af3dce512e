#pragma once

#include <cstddef>
#include <vector>

#include "render/gl/solid_painter.hpp"

namespace taut::render {

/// Occlusion test for balls, at the samples of SolidPainter: 2 × 2 per pixel.
class Cover {
 public:
  /// Size of the plot, pixels.
  Cover(int width, int height);

  void clear();
  /// Whether the added balls hide this ball completely. Conservative: false if in doubt.
  bool hides(const Ball& ball) const;
  void add(const Ball& ball);

 private:
  struct Tiles;
  bool hides(const Tiles& tiles, float front) const;
  void update(const Tiles& tiles);

  int width_, height_;            // samples
  int tile_columns_, tile_rows_;  // a tile is a square of samples
  std::vector<float> depth_;      // per sample: z up to which it is covered, pixels towards the camera
  std::vector<float> tile_;       // least depth of each tile
};

}  // namespace taut::render
