#pragma once

#include "render/page/canvas.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

/// A 2D wall with strokes, fixed to (x, y) on its face: pixels, y downwards. (nx, ny): unit normal away from the
/// wall.
void draw_wall_line(Canvas& canvas, const Rect& plot, double x, double y, double nx, double ny, double em);

}  // namespace taut::render
