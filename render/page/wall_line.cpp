#include "render/page/wall_line.hpp"

#include <cmath>

namespace taut::render {

void draw_wall_line(Canvas& canvas, const Rect& plot, double x, double y, double nx, double ny, double em) {
  // Lengths in em.
  constexpr double apart = 0.7, deep = 0.5;
  const double to_middle_x = plot.x + 0.5 * plot.width - x, to_middle_y = plot.y + 0.5 * plot.height - y;
  const double tx = -ny, ty = nx;
  const double along = to_middle_x * tx + to_middle_y * ty, off = to_middle_x * nx + to_middle_y * ny;
  const double reach = 0.5 * std::hypot(plot.width, plot.height) + em;
  constexpr double farthest = 1e9;  // pixels; beyond, rounding makes places inexact
  // returns for NaN, too
  if (!(std::abs(off) < reach && std::abs(along) < farthest)) return;
  cairo_t* cairo = canvas.cairo();
  cairo_save(cairo);
  cairo_rectangle(cairo, plot.x, plot.y, plot.width, plot.height);
  cairo_clip(cairo);
  canvas.gray(faint);
  cairo_set_line_width(cairo, 1.5 * line_width(em));
  const auto line = [&](double from, double from_deep, double to, double to_deep) {
    cairo_move_to(cairo, x + from * tx - from_deep * nx, y + from * ty - from_deep * ny);
    cairo_line_to(cairo, x + to * tx - to_deep * nx, y + to * ty - to_deep * ny);
    cairo_stroke(cairo);
  };
  line(along - reach, 0, along + reach, 0);
  cairo_set_line_width(cairo, line_width(em));
  const double step = apart * em, first = std::ceil((along - reach) / step);
  const int strokes = static_cast<int>(2 * reach / step);
  for (int k = 0; k <= strokes; ++k) line((first + k) * step, 0, (first + k) * step - deep * em, deep * em);
  cairo_restore(cairo);
}

}  // namespace taut::render
