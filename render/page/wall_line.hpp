#pragma once

#include "render/page/canvas.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

/// Draws the face of a 2D wall through the pixel (x, y), y downwards. (nx, ny): unit normal away from the wall.
void draw_wall_line(Canvas& canvas, const Rect& plot, double x, double y, double nx, double ny, double em);

}  // namespace taut::render
