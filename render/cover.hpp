#pragma once

#include <cstddef>
#include <vector>

#include "render/gl/solid_painter.hpp"

namespace taut::render {

/// What some balls leave to be seen of others. It knows the samples that SolidPainter takes, four a pixel.
class Cover {
 public:
  /// Of a plot of so many pixels.
  Cover(int width, int height);

  void clear();
  /// Whether the balls that were added cover all that could be seen of this one. Where it is not sure it says
  /// no.
  bool hides(const Ball& ball) const;
  void add(const Ball& ball);

 private:
  struct Tiles;
  bool hides(const Tiles& tiles, float front) const;
  void update(const Tiles& tiles);

  int width_, height_;            // samples
  int tile_columns_, tile_rows_;  // a tile is a square of samples
  std::vector<float> depth_;      // of each sample: no less than this, pixels towards the camera, is covered
  std::vector<float> tile_;       // the least of each tile
};

}  // namespace taut::render
