#pragma once

#include "render/page/canvas.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

/// In the bottom right corner of the plot or, if `below`, under this corner.
void draw_axes_marker(Canvas& canvas, const Rect& plot, const AxesMarker& axes, double em,
                      bool below = false);

}  // namespace taut::render
