#pragma once

#include "render/page/canvas.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

/// The face of a wall in 2D as far as the plot shows it, with strokes behind it. (x, y) of the face are pixels
/// of the picture, downwards; (nx, ny), of length 1, points away from the wall. The strokes stay with (x, y).
void draw_wall_line(Canvas& canvas, const Rect& plot, double x, double y, double nx, double ny, double em);

}  // namespace taut::render
