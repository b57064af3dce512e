#include "render/page/segments.hpp"

#include <cmath>

namespace taut::render {

void draw_segments(Canvas& canvas, const PageLayout& layout, std::span<const double> segments, Stroke stroke,
                   double em) {
  cairo_t* cairo = canvas.cairo();
  const Rect& plot = layout.plot;
  cairo_save(cairo);
  cairo_rectangle(cairo, plot.x, plot.y, plot.width, plot.height);
  cairo_clip(cairo);
  canvas.gray(stroke == Stroke::bold ? ink : faint);
  cairo_set_line_width(cairo, (stroke == Stroke::bold ? 1.5 : 1) * line_width(em));
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  for (std::size_t k = 0; k + 3 < segments.size(); k += 4) {
    const double x0 = plot.x + layout.column(segments[k]), y0 = plot.y + layout.row(segments[k + 1]);
    const double x1 = plot.x + layout.column(segments[k + 2]), y1 = plot.y + layout.row(segments[k + 3]);
    constexpr double farthest = 1e6;  // pixels
    const auto near = [](double pixel) { return std::abs(pixel) < farthest; };
    if (!(near(x0) && near(y0) && near(x1) && near(y1))) continue;
    cairo_move_to(cairo, x0, y0);
    cairo_line_to(cairo, x1, y1);
  }
  cairo_stroke(cairo);
  cairo_restore(cairo);
}

}  // namespace taut::render
