#pragma once

#include <optional>
#include <string>
#include <variant>

#include "engine/frame_view.hpp"
#include "render/page/axes_marker.hpp"
#include "render/page/canvas.hpp"
#include "render/page/legend.hpp"
#include "render/page/page_layout.hpp"
#include "render/page/scales.hpp"

namespace taut::render {

class ColorKey {
 public:
  explicit ColorKey(ColorBar bar) : key_(std::move(bar)) {}
  explicit ColorKey(Legend legend) : key_(std::move(legend)) {}

  /// Draws an upright key at the left edge of `room`, or a horizontal key along its width.
  void draw(Canvas& canvas, const Rect& room, double em, std::string_view field, std::string_view unit);
  void draw_off_scale(Canvas& canvas, const Rect& room, double em, const OffScale& off_scale);
  /// Width in em, for a height in pixels.
  double width(int height, double em, std::string_view unit) const;

 private:
  std::variant<ColorBar, Legend> key_;
};

class Annotation {
 public:
  /// The image must outlive the annotation and not move its pixels. `until`: see Renderer.
  Annotation(Image& image, const PageLayout& layout, ColorKey key, double until, Rgb background,
             const PageTexts& texts = {});

  void show(const AxesMarker& axes) { axes_ = axes; }
  /// Call in perspective.
  void hide_scale_bar() { has_scale_bar_ = false; }

  void draw(const FrameView& frame, const OffScale& off_scale);
  /// Whether `draw_again` is sufficient for `frame`.
  bool is_current_for(const FrameView& frame) const { return frame.field == field_ && frame.unit == unit_; }
  const std::set<std::string>& cut_texts() const { return canvas_.cut(); }
  /// Replaces title, method, time and off-scale marks.
  void draw_again(const FrameView& frame, const OffScale& off_scale);

 private:
  void draw_header(const FrameView& frame);

  PageLayout layout_;
  double until_;
  TextParts parts_;
  bool axes_outside_;
  Canvas canvas_;
  ColorKey key_;
  OffScale off_scale_;
  std::optional<AxesMarker> axes_;
  bool has_scale_bar_ = true;
  std::string field_, unit_;
};

void draw_title(Canvas& canvas, const std::string& title, const std::string& note, double left, double y,
                double room, double em);

}  // namespace taut::render
