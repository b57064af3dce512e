#include "render/page/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>
#include <stdexcept>
#include <vector>

namespace taut::render {

double line_width(double em) { return std::max(1.0, std::round(em / 14)); }

Canvas::Canvas(Image& image, Rgb background)
    : regular_(find_font(Weight::regular)),
      bold_(find_font(Weight::bold)),
      background_(background),
      transparent_(image.transparent),
      contrast_(is_light(background) ? 0 : 1),
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

void Canvas::begin() { cairo_surface_mark_dirty(surface_.get()); }

void Canvas::end() {
  cairo_surface_flush(surface_.get());
  const cairo_status_t status = cairo_status(cairo_.get());
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("Cairo failed to draw: ") + cairo_status_to_string(status));
}

void Canvas::gray(double level) {
  erases_ = transparent_ && level == 1;
  if (transparent_) return cairo_set_source_rgba(cairo_.get(), contrast_, contrast_, contrast_, 1 - level);
  const auto part = [&](std::size_t k) { return contrast_ + level * (background_[k] / 255.0 - contrast_); };
  cairo_set_source_rgb(cairo_.get(), part(0), part(1), part(2));
}

void Canvas::color(Rgb color) {
  erases_ = false;
  cairo_set_source_rgb(cairo_.get(), color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
}

void Canvas::use(Weight weight, double size) {
  (weight == Weight::bold ? bold_ : regular_).use(cairo_.get(), size);
}

void Canvas::fill(double x, double y, double width, double height) {
  cairo_set_operator(cairo_.get(), erases_ ? CAIRO_OPERATOR_CLEAR : CAIRO_OPERATOR_OVER);
  cairo_rectangle(cairo_.get(), x, y, width, height);
  cairo_fill(cairo_.get());
  cairo_set_operator(cairo_.get(), CAIRO_OPERATOR_OVER);
}

void Canvas::text(const std::string& text, double x, double y, Align align) {
  if (text.empty()) return;
  const double share = align == Align::left ? 0 : align == Align::centre ? 0.5 : 1;
  cairo_glyph_t* glyphs = nullptr;
  int count = 0;
  cairo_scaled_font_text_to_glyphs(cairo_get_scaled_font(cairo_.get()), x - share * width_of(text), y,
                                   text.c_str(), static_cast<int>(text.size()), &glyphs, &count, nullptr,
                                   nullptr, nullptr);
  // Cairo before 1.17.4 rounds to whole pixels, later versions to quarters
  for (int k = 0; k < count; ++k) {
    cairo_user_to_device(cairo_.get(), &glyphs[k].x, &glyphs[k].y);
    glyphs[k].x = std::round(glyphs[k].x), glyphs[k].y = std::round(glyphs[k].y);
    cairo_device_to_user(cairo_.get(), &glyphs[k].x, &glyphs[k].y);
  }
  cairo_show_glyphs(cairo_.get(), glyphs, count);
  cairo_glyph_free(glyphs);
}

void Canvas::turned_text(const std::string& words, double x, double y) {
  cairo_save(cairo_.get());
  cairo_translate(cairo_.get(), x, y);
  cairo_rotate(cairo_.get(), -0.5 * M_PI);
  text(words, 0, 0, Align::centre);
  cairo_restore(cairo_.get());
}

double Canvas::width_of(const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

std::string Canvas::fitted(std::string text, double room) {
  if (text.empty() || width_of(text) <= room) return text;
  cut_.insert(text);
  std::vector<std::size_t> ends;
  for (std::size_t k = 1; k < text.size(); ++k)
    if ((static_cast<unsigned char>(text[k]) & 0xc0) != 0x80) ends.push_back(k);
  const auto fits = [&](std::size_t end) { return width_of(text.substr(0, end) + "…") <= room; };
  const auto first_too_long = std::ranges::partition_point(ends, fits);
  return first_too_long == ends.begin() ? "" : text.substr(0, *std::prev(first_too_long)) + "…";
}

}  // namespace taut::render
