#pragma once

#include "render/page/canvas.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

/// Draws the face of a 2D wall through the point (x, y), in pixels of the picture, y downwards. The strokes behind the
/// face move with this point. (nx, ny) is the unit normal away from the wall.
void draw_wall_line(Canvas& canvas, const Rect& plot, double x, double y, double nx, double ny, double em);

}  // namespace taut::render
