#include "render/page/scales.hpp"

#include <algorithm>
#include <cmath>

namespace taut::render {
namespace {

// Lengths in em.
constexpr double bar_width = 1.15;
constexpr double small_size = 0.94;
constexpr double tick_length = 0.3;
constexpr double tick_gap = 0.25;
constexpr double tick_spacing = 3.8, tick_spacing_across = 5;  // minima
constexpr double longest_bar = 36, inset_across = 1;           // inset: for numbers at the bar's ends
constexpr double baseline_of_label = 3.65;                     // across
constexpr double label_gap = 0.75;
constexpr double most_beyond = 0.3;
constexpr double arrow_height = 0.42;  // fits below the header
constexpr double arrow_gap = 0.13;
constexpr double swatch_size = 0.75;
constexpr double swatch_gap = 0.35;
constexpr double width_of_swatch = 6.6;

/// Width in DejaVu Sans, per font size.
double width_of_number(std::string_view label) {
  constexpr double digit = 0.636, point = 0.318, minus = 0.838;
  double width = label.starts_with("−") ? minus : 0;
  for (const char c : label) width += c == '.' ? point : c >= '0' && c <= '9' ? digit : 0;
  // "×10⁶" and the power's minus
  if (const std::size_t times = label.find("×"); times != std::string_view::npos) {
    constexpr double raised = 0.42;
    const std::string_view power = label.substr(times + std::string_view("×10").size());
    width += minus + raised * static_cast<double>(std::ranges::count_if(power, [](char c) {
                       return (static_cast<unsigned char>(c) & 0xc0) == 0xc0;
                     }));
  }
  return width;
}

double width_with(double widest) {
  return bar_width + tick_length + tick_gap + widest + label_gap + cap_height;
}

}  // namespace

std::string label_of_bar(Canvas& canvas, std::string_view field, const std::string& unit, double room) {
  const std::string end = unit.empty() ? "" : "(" + unit + ")";
  const double left = room - canvas.width_of(end);
  if (left < 0) return "";
  std::string name = canvas.fitted(std::string(field), end.empty() ? left : left - canvas.width_of(" "));
  if (!name.empty() && !end.empty()) name += " ";
  return name + end;
}

ColorBar::ColorBar(double low, double high, const std::array<Rgb, 256>& colors, Rgb no_number,
                   const NumberFormat& format, bool across)
    : low_(low), high_(high), colors_(colors), no_number_(no_number), format_(format), across_(across) {}

Rect ColorBar::bar_in(const Rect& room, double em) const {
  const int thick = static_cast<int>(std::lround(bar_width * em));
  if (!across_) return {room.x, room.y, thick, room.height};
  const int length =
      static_cast<int>(std::lround(std::min(room.width - 2 * inset_across * em, longest_bar * em)));
  return {room.x + (room.width - length) / 2, room.y, length, thick};
}

Ticks ColorBar::ticks(int length, double em, std::string_view unit) const {
  const double spacing = across_ ? tick_spacing_across : tick_spacing;
  const int room = std::clamp(static_cast<int>(length / (spacing * em)), 3, 12);
  Ticks all = nice_ticks(low_, high_, unit, room, format_);
  return all.at.size() < 2 ? nice_ticks(low_, high_, unit, 5, format_) : all;  // one number is useless
}

double ColorBar::width(int height, double em, std::string_view unit) const {
  double widest = 0;
  for (const Tick& tick : ticks(height, em, unit).at) widest = std::max(widest, width_of_number(tick.label));
  return width_with(small_size * widest);
}

void ColorBar::draw(Canvas& canvas, const Rect& room, double em, std::string_view field,
                    std::string_view unit) {
  const Rect bar = bar_in(room, em);
  const int length = across_ ? bar.width : bar.height;
  for (int k = 0; k < length; ++k) {
    const double t = (k + 0.5) / length;
    canvas.color(colors_[static_cast<std::size_t>(std::lround((across_ ? t : 1 - t) * 255))]);
    if (across_)
      canvas.fill(bar.x + k, bar.y, 1, bar.height);
    else
      canvas.fill(bar.x, bar.y + k, bar.width, 1);
  }
  if (ticks_.at.empty() || tick_unit_ != unit) {
    tick_unit_ = unit;
    ticks_ = ticks(length, em, unit);
  }
  canvas.gray(ink);
  if (across_)
    draw_across(canvas, bar, em, field);
  else
    draw_upright(canvas, room, bar, em, field);
}

void ColorBar::draw_upright(Canvas& canvas, const Rect& room, const Rect& bar, double em,
                            std::string_view field) const {
  canvas.use(Weight::regular, small_size * em);
  double widest = 0;
  for (const Tick& tick : ticks_.at) widest = std::max(widest, canvas.width_of(tick.label));
  canvas.use(Weight::regular, em);
  const std::string label = label_of_bar(canvas, field, ticks_.unit, bar.height);
  const double right = bar.width + (width_with(widest / em) - bar_width) * em;  // the bar has whole pixels
  if (right > room.width + most_beyond * em || (label.empty() && !ticks_.unit.empty()))
    return canvas.omit("numbers of the colour bar");
  canvas.turned_text(label, bar.x + right, bar.y + 0.5 * bar.height);
  draw_ticks(canvas, bar, em);
}

void ColorBar::draw_across(Canvas& canvas, const Rect& bar, double em, std::string_view field) const {
  canvas.use(Weight::regular, em);
  const std::string label = label_of_bar(canvas, field, ticks_.unit, bar.width);
  if (label.empty() && !ticks_.unit.empty()) return canvas.omit("numbers of the colour bar");
  canvas.text(label, bar.x + 0.5 * bar.width, bar.y + baseline_of_label * em, Canvas::Align::centre);
  canvas.use(Weight::regular, small_size * em);
  const double line = line_width(em), end = bar.y + bar.height;
  for (const Tick& tick : ticks_.at) {
    const double x = bar.x + bar.width * (tick.value - low_) / (high_ - low_);
    const double left = std::clamp(std::round(x - 0.5 * line), double(bar.x), bar.x + bar.width - line);
    canvas.fill(left, end, line, std::round(tick_length * em));
    canvas.text(tick.label, x, end + (tick_length + tick_gap + cap_height * small_size) * em,
                Canvas::Align::centre);
  }
}

void ColorBar::draw_ticks(Canvas& canvas, const Rect& bar, double em) const {
  const double line = line_width(em);
  canvas.use(Weight::regular, small_size * em);
  for (const Tick& tick : ticks_.at) {
    const double y = bar.y + bar.height * (high_ - tick.value) / (high_ - low_);
    const double top = std::clamp(std::round(y - 0.5 * line), double(bar.y), bar.y + bar.height - line);
    canvas.fill(bar.x + bar.width, top, std::round(tick_length * em), line);
    canvas.text(tick.label, bar.x + bar.width + (tick_length + tick_gap) * em,
                y + 0.5 * cap_height * small_size * em, Canvas::Align::left);
  }
}

void ColorBar::draw_off_scale(Canvas& canvas, const Rect& room_of_all, double em,
                              const OffScale& found) const {
  const Rect bar = bar_in(room_of_all, em);
  const double gap = std::max(2.0, std::round(arrow_gap * em));
  const double room = std::ceil(arrow_height * em + gap) + 1;
  // `way`: outward direction, ±1.
  const auto draw_end = [&](double edge, double way, bool arrow, Rgb color) {
    const double begin = way < 0 ? edge - room : edge;
    canvas.gray(1);
    if (across_)
      canvas.fill(begin, bar.y - 1, room, bar.height + 2);
    else
      canvas.fill(bar.x - 1, begin, bar.width + 2, room);
    if (!arrow) return;
    const double base = edge + way * gap, tip = base + way * arrow_height * em;
    const auto to = [&](double along, double share, auto draw) {
      across_ ? draw(canvas.cairo(), along, bar.y + share * bar.height)
              : draw(canvas.cairo(), bar.x + share * bar.width, along);
    };
    to(base, 0, cairo_move_to);
    to(tip, 0.5, cairo_line_to);
    to(base, 1, cairo_line_to);
    cairo_close_path(canvas.cairo());
    canvas.color(color);
    cairo_fill(canvas.cairo());
  };
  const double low_end = across_ ? bar.x : bar.y + bar.height, high_end = across_ ? bar.x + bar.width : bar.y;
  const double outwards = across_ ? 1 : -1;
  draw_end(high_end, outwards, found.above, colors_.back());
  draw_end(low_end, -outwards, found.below, colors_.front());
  const double side = std::round(swatch_size * em);
  const double left = across_ ? room_of_all.x + room_of_all.width - width_of_swatch * em : bar.x;
  const double top = across_ ? bar.y - side - 2 * gap : bar.y + bar.height + room;
  canvas.gray(1);
  canvas.fill(left - 1, top, width_of_swatch * em, side + 2 * gap);
  if (!found.no_number) return;
  canvas.color(no_number_);
  canvas.fill(left, top + gap, side, side);
  canvas.gray(ink);
  canvas.use(Weight::regular, small_size * em);
  canvas.text("no number", left + side + swatch_gap * em,
              top + gap + 0.5 * side + 0.5 * cap_height * small_size * em, Canvas::Align::left);
}

void draw_scale_bar(Canvas& canvas, const Rect& plot, double pixels_per_metre, double em) {
  const double length = nice_length(0.2 * plot.width / pixels_per_metre);
  const Scale scale = scale_for(length, "m");
  const double line = line_width(em);
  const double left = plot.x;
  const double middle = std::round(plot.y + plot.height + 1.15 * em);
  const double right = left + std::round(length * pixels_per_metre);
  const double cap = std::round(0.22 * em);
  canvas.gray(ink);
  canvas.fill(left, middle, right - left, line);
  canvas.fill(left, middle - cap, line, 2 * cap + line);
  canvas.fill(right - line, middle - cap, line, 2 * cap + line);
  canvas.use(Weight::regular, small_size * em);
  canvas.text(format_fixed(length * scale.factor, 0) + " " + scale.unit, right + 0.5 * em,
              middle + 0.5 * line + 0.5 * cap_height * small_size * em, Canvas::Align::left);
}

}  // namespace taut::render
