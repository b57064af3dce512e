#include "render/annotation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace taut {
namespace {

// Lengths in em.
constexpr double title_size = 1.3;
constexpr double small_size = 0.94;
constexpr double baseline_of_header = 1.8;
constexpr double tick_length = 0.3;
constexpr double tick_gap = 0.25;     // between tick and number
constexpr double tick_spacing = 3.8;  // least distance between numbers
constexpr double cap_height = 0.73;   // of the digits of DejaVu Sans, per size
constexpr double label_gap = 0.75;    // between the widest number and the turned label

constexpr double ink = 0.13;  // gray levels: black is too hard on white
constexpr double faint = 0.42;

void gray(cairo_t* cairo, double level) { cairo_set_source_rgb(cairo, level, level, level); }

/// A hairline that falls on whole pixels.
double line_width(double em) { return std::max(1.0, std::round(em / 14)); }

}  // namespace

Annotation::Annotation(Image& image, const Layout& layout, const DrawOptions& options)
    : layout_(layout),
      low_(options.low),
      high_(options.high),
      until_(options.until),
      colors_(options.colormap->table()),
      regular_(find_font(Weight::regular)),
      bold_(find_font(Weight::bold)),
      surface_(cairo_image_surface_create_for_data(image.pixels.data(), CAIRO_FORMAT_ARGB32, image.width,
                                                   image.height, image.width * 4)),
      cairo_(cairo_create(surface_.get())) {
  cairo_font_options_t* font_options = cairo_font_options_create();
  cairo_font_options_set_hint_style(font_options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(font_options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(font_options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(cairo_.get(), font_options);
  cairo_font_options_destroy(font_options);
}

void Annotation::draw(const FrameView& frame) {
  cairo_surface_mark_dirty(surface_.get());  // OpenGL wrote into it
  draw_header(frame);
  draw_bar(frame);
  draw_bar_label(frame);
  draw_scale_bar();
  cairo_surface_flush(surface_.get());
  if (cairo_status(cairo_.get()) != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(std::string("Cairo failed to draw: ") +
                             cairo_status_to_string(cairo_status(cairo_.get())));
  }
}

void Annotation::draw_header(const FrameView& frame) {
  const double em = layout_.font;
  const double left = layout_.plot.x;
  const double right = layout_.right;
  const double y = baseline_of_header * em;

  regular_.use(cairo_.get(), em);
  const std::string time = format_time(frame.time, until_);
  gray(cairo_.get(), ink);
  text(time, right, y, Align::right);
  const double room = right - left - width_of(time) - em;

  bold_.use(cairo_.get(), title_size * em);
  const std::string title = fitted(std::string(frame.title), room);
  text(title, left, y, Align::left);
  const double method_left = left + (title.empty() ? 0 : width_of(title) + em);

  regular_.use(cairo_.get(), em);
  gray(cairo_.get(), faint);
  text(fitted(std::string(frame.method), left + room - method_left), method_left, y, Align::left);
}

void Annotation::draw_bar(const FrameView& frame) {
  cairo_t* cairo = cairo_.get();
  const double em = layout_.font;
  const Rect& bar = layout_.bar;
  for (int row = 0; row < bar.height; ++row) {
    const double t = 1 - (row + 0.5) / bar.height;
    const Rgb color = colors_[static_cast<std::size_t>(std::lround(t * 255))];
    cairo_set_source_rgb(cairo, color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
    cairo_rectangle(cairo, bar.x, bar.y + row, bar.width, 1);
    cairo_fill(cairo);
  }

  if (ticks_.at.empty() || tick_unit_ != frame.unit) {
    tick_unit_ = frame.unit;
    ticks_ = nice_ticks(low_, high_, frame.unit,
                        std::clamp(static_cast<int>(bar.height / (tick_spacing * em)), 3, 12));
  }
  const double line = line_width(em);
  gray(cairo, ink);
  regular_.use(cairo, small_size * em);
  for (const Tick& tick : ticks_.at) {
    const double y = bar.y + bar.height * (high_ - tick.value) / (high_ - low_);
    const double top = std::clamp(std::round(y - 0.5 * line), double(bar.y), bar.y + bar.height - line);
    cairo_rectangle(cairo, bar.x + bar.width, top, std::round(tick_length * em), line);
    cairo_fill(cairo);
    text(tick.label, bar.x + bar.width + (tick_length + tick_gap) * em,
         y + 0.5 * cap_height * small_size * em, Align::left);
  }
}

void Annotation::draw_bar_label(const FrameView& frame) {
  cairo_t* cairo = cairo_.get();
  const double em = layout_.font;
  const Rect& bar = layout_.bar;
  double widest = 0;
  for (const Tick& tick : ticks_.at) widest = std::max(widest, width_of(tick.label));
  regular_.use(cairo, em);
  gray(cairo, ink);
  std::string label(frame.field);
  if (!ticks_.unit.empty()) label += " (" + ticks_.unit + ")";
  cairo_save(cairo);
  cairo_translate(cairo, bar.x + bar.width + (tick_length + tick_gap + label_gap + cap_height) * em + widest,
                  bar.y + 0.5 * bar.height);
  cairo_rotate(cairo, -0.5 * M_PI);
  text(fitted(label, bar.height), 0, 0, Align::centre);
  cairo_restore(cairo);
}

void Annotation::draw_scale_bar() {
  cairo_t* cairo = cairo_.get();
  const double em = layout_.font;
  const double length = nice_length(0.2 * layout_.plot.width / layout_.pixels_per_metre);
  const Scale scale = scale_for(length, "m");
  const double line = line_width(em);
  const double left = layout_.plot.x;
  const double middle = std::round(layout_.plot.y + layout_.plot.height + 1.15 * em);
  const double right = left + std::round(length * layout_.pixels_per_metre);
  const double cap = std::round(0.22 * em);
  gray(cairo, ink);
  cairo_rectangle(cairo, left, middle, right - left, line);
  cairo_rectangle(cairo, left, middle - cap, line, 2 * cap + line);
  cairo_rectangle(cairo, right - line, middle - cap, line, 2 * cap + line);
  cairo_fill(cairo);
  regular_.use(cairo, small_size * em);
  text(format_fixed(length * scale.factor, 0) + " " + scale.unit, right + 0.5 * em,
       middle + 0.5 * line + 0.5 * cap_height * small_size * em, Align::left);
}

double Annotation::width_of(const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

void Annotation::text(const std::string& text, double x, double y, Align align) {
  if (text.empty()) return;
  const double share = align == Align::left ? 0 : align == Align::centre ? 0.5 : 1;
  cairo_move_to(cairo_.get(), x - share * width_of(text), y);
  cairo_show_text(cairo_.get(), text.c_str());
}

std::string Annotation::fitted(std::string text, double room) {
  if (width_of(text) <= room) return text;
  while (!text.empty()) {
    // a letter is one byte, or a leading byte and those that continue it
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
    if (!text.empty()) text.pop_back();
    if (!text.empty() && width_of(text + "…") <= room) return text + "…";
  }
  return text;
}

}  // namespace taut
