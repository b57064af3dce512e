#pragma once

#include <cstdint>
#include <span>

#include "render/page/canvas.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

enum class Stroke : std::uint8_t { thin, bold };

/// Draws 2D segments of four coordinates each, in m.
void draw_segments(Canvas& canvas, const PageLayout& layout, std::span<const double> segments, Stroke stroke,
                   double em);

}  // namespace taut::render
