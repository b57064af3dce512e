#pragma once

#include <optional>
#include <string>

#include "engine/frame_view.hpp"
#include "render/page/axes_marker.hpp"
#include "render/page/canvas.hpp"
#include "render/page/page_layout.hpp"
#include "render/page/scales.hpp"

namespace taut::render {

/// Title, method, time, colour bar, scale bar, and the axes of a scene in 3D, drawn over a picture.
class Annotation {
 public:
  /// The image must outlive the annotation and keep its pixels where they are.
  /// `until`: time of the last frame, s, that gives the unit of all times; 0: each has its own.
  Annotation(Image& image, const PageLayout& layout, ColorBar bar, double until);

  /// Shows the axes of a scene in 3D.
  void show(const AxesMarker& axes) { axes_ = axes; }
  /// Lengths are not the same all over the picture.
  void leave_out_scale_bar() { has_scale_bar_ = false; }

  void draw(const FrameView& frame);
  /// Whether what was drawn last would be the same for this frame, but for the header.
  bool stands_for(const FrameView& frame) const { return frame.field == field_ && frame.unit == unit_; }
  /// Title, method and time, in place of those that were drawn last.
  void draw_header_again(const FrameView& frame);

 private:
  void draw_header(const FrameView& frame);

  PageLayout layout_;
  double until_;
  Canvas canvas_;
  ColorBar bar_;
  std::optional<AxesMarker> axes_;
  bool has_scale_bar_ = true;
  std::string field_, unit_;  // of the bar that was drawn last
};

/// A title in bold, what qualifies it in gray behind, no wider than `room` together.
void draw_title(Canvas& canvas, const std::string& title, const std::string& note, double left, double y,
                double room, double em);

}  // namespace taut::render
