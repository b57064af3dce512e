#include "render/page/axes_marker.hpp"

#include <algorithm>

namespace taut::render {
namespace {

// Lengths in em.
constexpr double axis_length = 1.5;
constexpr double letter_at = 1.95;
constexpr double corner_gap = 2.4;
constexpr double letter_size = 0.94;

}  // namespace

void draw_axes_marker(Canvas& canvas, const Rect& plot, const AxesMarker& axes, double em, bool below) {
  const double x = plot.x + plot.width - corner_gap * em;
  const double y = plot.y + plot.height + (below ? 0.5 * room_of_axes : -corner_gap) * em;
  std::array<std::size_t, 3> order{0, 1, 2};
  std::ranges::sort(order, {}, [&](std::size_t axis) { return axes[axis][2]; });
  canvas.use(Weight::regular, letter_size * em);
  for (const std::size_t axis : order) {
    const auto& [right, up, towards] = axes[axis];
    canvas.gray(towards < 0 ? faint : ink);
    cairo_set_line_width(canvas.cairo(), 1.5 * line_width(em));
    cairo_move_to(canvas.cairo(), x, y);
    cairo_line_to(canvas.cairo(), x + axis_length * em * right, y - axis_length * em * up);
    cairo_stroke(canvas.cairo());
    canvas.text(std::string(1, "xyz"[axis]), x + letter_at * em * right,
                y - letter_at * em * up + 0.5 * cap_height * letter_size * em, Canvas::Align::centre);
  }
}

}  // namespace taut::render
