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
constexpr double gap_across = 1.2;
constexpr double letter_width = 0.62;  // average
constexpr double small_size = 0.94;

/// Counts characters, not bytes.
double length_of(std::string_view text) {
  return static_cast<double>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

/// Number of entries drawn.
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
  canvas.use(Weight::regular, small_size * em);
  if (across_)
    draw_across(canvas, room, em);
  else
    draw_upright(canvas, room, em);
}

namespace {

void draw_disc(Canvas& canvas, const Rgb& color, double left, double middle, double em) {
  canvas.color(color);
  cairo_arc(canvas.cairo(), left + disc_radius * em, middle, disc_radius * em, 0, 2 * std::numbers::pi);
  cairo_fill(canvas.cairo());
}

void write(Canvas& canvas, const std::string& text, double left, double middle, double em) {
  canvas.text(text, left, middle + 0.5 * cap_height * small_size * em, Canvas::Align::left);
}

}  // namespace

void Legend::draw_upright(Canvas& canvas, const Rect& room, double em) const {
  const std::size_t written = shown(room.height, em);
  double middle = room.y + (title_height + 0.5 * line_height) * em;
  const auto write_line = [&](const std::string& text) {
    write(canvas, canvas.fitted(text, room.width - text_left * em), room.x + text_left * em, middle, em);
    middle += line_height * em;
  };
  for (std::size_t k = 0; k < written; ++k) {
    draw_disc(canvas, entries_[k].color, room.x, middle, em);
    canvas.gray(ink);
    write_line(entries_[k].name);
  }
  canvas.gray(faint);
  write_line(rest(written));
}

void Legend::draw_across(Canvas& canvas, const Rect& room, double em) const {
  const double middle = room.y + (title_height + 0.5 * line_height) * em, end = room.x + room.width;
  const auto width = [&](const std::string& text) { return canvas.width_of(text) + text_left * em; };
  double left = room.x;
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const std::string& name = entries_[k].name;
    const std::string others = rest(k + 1);
    if (left + width(name) + (others.empty() ? 0 : gap_across * em + width(others)) > end && k > 0) {
      canvas.gray(faint);
      write(canvas, canvas.fitted(rest(k), end - left), left, middle, em);
      return;
    }
    draw_disc(canvas, entries_[k].color, left, middle, em);
    canvas.gray(ink);
    write(canvas, canvas.fitted(name, end - left - text_left * em), left + text_left * em, middle, em);
    left += width(name) + gap_across * em;
  }
}

}  // namespace taut::render
