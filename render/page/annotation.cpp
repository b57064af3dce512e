#include "render/page/annotation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut::render {
namespace {

// Lengths in em.
constexpr double title_size = 1.3;
constexpr double baseline_of_header = 1.8;
constexpr double end_of_header = 2.4;

constexpr double most_of_note = 0.5;  // of the room for title and note

constexpr double most_room_of_legend = 14;

}  // namespace

void ColorKey::draw(Canvas& canvas, const Rect& room, double em, std::string_view field,
                    std::string_view unit) {
  if (const auto* legend = std::get_if<Legend>(&key_)) return legend->draw(canvas, room, em, field);
  std::get<ColorBar>(key_).draw(canvas, room, em, field, unit);
}

void ColorKey::draw_off_scale(Canvas& canvas, const Rect& room, double em, const OffScale& off_scale) {
  if (const auto* bar = std::get_if<ColorBar>(&key_)) bar->draw_off_scale(canvas, room, em, off_scale);
}

double ColorKey::width(int height, double em, std::string_view unit) const {
  if (const auto* legend = std::get_if<Legend>(&key_))
    return std::clamp(legend->width(height, em), room_of_bar, most_room_of_legend);
  return std::max(std::get<ColorBar>(key_).width(height, em, unit), room_of_bar);
}

Annotation::Annotation(Image& image, const PageLayout& layout, ColorKey key, double until, Rgb background,
                       const PageTexts& texts)
    : layout_(layout),
      until_(until),
      parts_(texts.parts),
      axes_outside_(texts.axes_outside),
      canvas_(image, background),
      key_(std::move(key)) {}

void Annotation::draw(const FrameView& frame, const OffScale& off_scale) {
  canvas_.begin();
  draw_header(frame);
  if (parts_.bar) {
    key_.draw(canvas_, layout_.key, layout_.font, frame.field, frame.unit);
    key_.draw_off_scale(canvas_, layout_.key, layout_.font, off_scale);
  }
  if (has_scale_bar_ && parts_.scale)
    draw_scale_bar(canvas_, layout_.plot, layout_.pixels_per_metre, layout_.font);
  if (axes_ && parts_.axes) draw_axes_marker(canvas_, layout_.plot, *axes_, layout_.font, axes_outside_);
  canvas_.end();
  field_ = frame.field, unit_ = frame.unit;
  off_scale_ = off_scale;
}

void Annotation::draw_again(const FrameView& frame, const OffScale& off_scale) {
  canvas_.begin();
  if (parts_.header()) {
    canvas_.gray(1);
    canvas_.fill(0, 0, layout_.right + layout_.font, std::floor(end_of_header * layout_.font));
  }
  draw_header(frame);
  if (off_scale != off_scale_ && parts_.bar)
    key_.draw_off_scale(canvas_, layout_.key, layout_.font, off_scale);
  off_scale_ = off_scale;
  canvas_.end();
}

void Annotation::draw_header(const FrameView& frame) {
  const double em = layout_.font;
  const double left = layout_.left;
  const double y = baseline_of_header * em;
  canvas_.use(Weight::regular, em);
  const std::string time = parts_.time ? format_time(frame.time, until_) : "";
  canvas_.gray(ink);
  canvas_.text(time, layout_.right, y, Canvas::Align::right);
  const double room = layout_.right - left - canvas_.width_of(time) - em;
  draw_title(canvas_, std::string(parts_.title ? frame.title : ""),
             std::string(parts_.method ? frame.method : ""), left, y, room, em);
}

void draw_title(Canvas& canvas, const std::string& title, const std::string& note, double left, double y,
                double room, double em) {
  canvas.use(Weight::regular, em);
  const double of_note = note.empty() ? 0 : em + std::min(canvas.width_of(note), most_of_note * room);
  canvas.use(Weight::bold, title_size * em);
  canvas.gray(ink);
  const std::string shown = canvas.fitted(title, room - of_note);
  canvas.text(shown, left, y, Canvas::Align::left);
  const double note_left = left + (shown.empty() ? 0 : canvas.width_of(shown) + em);
  canvas.use(Weight::regular, em);
  canvas.gray(faint);
  canvas.text(canvas.fitted(note, left + room - note_left), note_left, y, Canvas::Align::left);
}

}  // namespace taut::render
