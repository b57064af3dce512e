#pragma once

#include "render/page/canvas.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

void draw_axes_marker(Canvas& canvas, const Rect& plot, const AxesMarker& axes, double em);

}  // namespace taut::render
