#pragma once

#include "engine/frame_view.hpp"
#include "render/canvas.hpp"
#include "render/layout.hpp"
#include "render/renderer.hpp"
#include "render/scales.hpp"

namespace taut {

/// Title, method, time, colour bar and scale bar, drawn over a picture.
class Annotation {
 public:
  /// The image must outlive the annotation and keep its pixels where they are.
  Annotation(Image& image, const Layout& layout, const DrawOptions& options);

  void draw(const FrameView& frame);

 private:
  void draw_header(const FrameView& frame);

  Layout layout_;
  double until_;
  Canvas canvas_;
  ColorBar bar_;
};

/// A title in bold, what qualifies it in gray behind, no wider than `room` together.
void draw_title(Canvas& canvas, const std::string& title, const std::string& note, double left, double y,
                double room, double em);

}  // namespace taut
