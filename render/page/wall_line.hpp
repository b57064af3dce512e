#pragma once

#include "render/page/canvas.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

/// Draws the visible face of a 2D wall with strokes behind it, which are fixed to (x, y). (x, y): a point of the face
/// in picture pixels, y downwards; (nx, ny): unit normal away from the wall.
void draw_wall_line(Canvas& canvas, const Rect& plot, double x, double y, double nx, double ny, double em);

}  // namespace taut::render
