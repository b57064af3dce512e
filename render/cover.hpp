#pragma once

#include <cstddef>
#include <vector>

#include "render/gl/solid_painter.hpp"

namespace taut::render {

/// Finds balls hidden by other balls, at the 2 × 2 samples per pixel of SolidPainter.
class Cover {
 public:
  Cover(int width, int height);

  void clear();
  /// Whether the added balls hide `ball`; false if in doubt.
  bool hides(const Ball& ball) const;
  void add(const Ball& ball);

 private:
  struct Tiles;
  bool hides(const Tiles& tiles, float front) const;
  void update(const Tiles& tiles);

  int width_, height_;  // samples
  int tile_columns_, tile_rows_;
  std::vector<float> depth_;  // z in pixels; all below is hidden
  std::vector<float> tile_;   // least depth in each tile
};

}  // namespace taut::render
