#include "render/page/legend.hpp"

#include <algorithm>
#include <numbers>

namespace taut::render {
namespace {

// Lengths in em.
constexpr double line_height = 1.55;
constexpr double title_height = 1.75;
constexpr double disc_radius = 0.45;
constexpr double text_left = 1.4;
constexpr double letter_width = 0.62;  // average
constexpr double small_size = 0.94;

/// Counts characters, not bytes.
double length_of(std::string_view text) {
  return static_cast<double>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

/// If not all entries fit, the last line contains the number of omitted entries.
std::size_t Legend::shown(int height, double em) const {
  const auto lines =
      static_cast<std::size_t>(std::max((height - title_height * em) / (line_height * em), 1.0));
  return entries_.size() <= lines ? entries_.size() : lines - 1;
}

std::string Legend::rest(std::size_t shown) const {
  return shown < entries_.size() ? "and " + std::to_string(entries_.size() - shown) + " more" : "";
}

double Legend::width(int height, double em) const {
  double longest = length_of(rest(shown(height, em)));
  for (const Entry& entry : entries_) longest = std::max(longest, length_of(entry.name));
  return text_left + letter_width * longest;
}

void Legend::draw(Canvas& canvas, const Rect& room, double em, std::string_view title) const {
  canvas.use(Weight::regular, em);
  canvas.gray(faint);
  canvas.text(canvas.fitted(std::string(title), room.width), room.x, room.y + cap_height * em,
              Canvas::Align::left);
  const std::size_t written = shown(room.height, em);
  canvas.use(Weight::regular, small_size * em);
  double middle = room.y + (title_height + 0.5 * line_height) * em;
  const auto write = [&](const std::string& text) {
    canvas.text(canvas.fitted(text, room.width - text_left * em), room.x + text_left * em,
                middle + 0.5 * cap_height * small_size * em, Canvas::Align::left);
    middle += line_height * em;
  };
  for (std::size_t k = 0; k < written; ++k) {
    canvas.color(entries_[k].color);
    cairo_arc(canvas.cairo(), room.x + disc_radius * em, middle, disc_radius * em, 0, 2 * std::numbers::pi);
    cairo_fill(canvas.cairo());
    canvas.gray(ink);
    write(entries_[k].name);
  }
  canvas.gray(faint);
  write(rest(written));
}

}  // namespace taut::render
