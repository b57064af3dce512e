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

/// What the colours of a picture mean.
class ColorKey {
 public:
  explicit ColorKey(ColorBar bar) : key_(std::move(bar)) {}
  explicit ColorKey(Legend legend) : key_(std::move(legend)) {}

  /// At the left of `room`, as high as it.
  void draw(Canvas& canvas, const Rect& room, double em, std::string_view field, std::string_view unit);
  void draw_off_scale(Canvas& canvas, const Rect& room, double em, const OffScale& off_scale);
  /// How much room it needs where it is `height` pixels high and what is coloured is in `unit`, em.
  double width(int height, double em, std::string_view unit) const;

 private:
  std::variant<ColorBar, Legend> key_;
};

/// Title, method, time, colour bar, scale bar, and the axes of a scene in 3D, drawn over a picture.
class Annotation {
 public:
  /// The image must outlive the annotation and keep its pixels where they are.
  /// `until`: time of the last frame, s, that gives the unit of all times; 0: each has its own.
  Annotation(Image& image, const PageLayout& layout, ColorKey key, double until, Rgb background);

  /// Shows the axes of a scene in 3D.
  void show(const AxesMarker& axes) { axes_ = axes; }
  /// Lengths are not the same all over the picture.
  void leave_out_scale_bar() { has_scale_bar_ = false; }

  void draw(const FrameView& frame, const OffScale& off_scale);
  /// Whether what was drawn last would be the same for this frame, but for the header and what is off the bar's
  /// scale.
  bool stands_for(const FrameView& frame) const { return frame.field == field_ && frame.unit == unit_; }
  /// Title, method, time and what is off the bar's scale, in place of those that were drawn last.
  void draw_again(const FrameView& frame, const OffScale& off_scale);

 private:
  void draw_header(const FrameView& frame);

  PageLayout layout_;
  double until_;
  Canvas canvas_;
  ColorKey key_;
  OffScale off_scale_;  // as it was drawn last
  std::optional<AxesMarker> axes_;
  bool has_scale_bar_ = true;
  std::string field_, unit_;  // of the bar that was drawn last
};

/// A title in bold, what qualifies it in gray behind, no wider than `room` together.
void draw_title(Canvas& canvas, const std::string& title, const std::string& note, double left, double y,
                double room, double em);

}  // namespace taut::render
