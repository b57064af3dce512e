#pragma once

#include <array>
#include <memory>
#include <string>

#include <cairo.h>

#include "engine/frame_view.hpp"
#include "render/font.hpp"
#include "render/layout.hpp"
#include "render/renderer.hpp"
#include "render/ticks.hpp"

namespace taut {

/// Title, method, time, colour bar and scale bar, drawn over a picture with Cairo.
class Annotation {
 public:
  /// The image must outlive the annotation and keep its pixels where they are.
  Annotation(Image& image, const Layout& layout, const DrawOptions& options);

  void draw(const FrameView& frame);

 private:
  enum class Align { left, centre, right };

  void draw_header(const FrameView& frame);
  void draw_bar(const FrameView& frame);
  void draw_bar_label(const FrameView& frame);
  void draw_scale_bar();

  double width_of(const std::string& text);
  /// Baseline at (x, y).
  void text(const std::string& text, double x, double y, Align align);
  /// Shortened with an ellipsis until it is no wider than `room`.
  std::string fitted(std::string text, double room);

  struct Deleter {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
  };

  Layout layout_;
  double low_, high_;
  double until_;
  std::array<Rgb, 256> colors_;
  Font regular_, bold_;
  std::unique_ptr<cairo_surface_t, Deleter> surface_;
  std::unique_ptr<cairo_t, Deleter> cairo_;
  Ticks ticks_;
  std::string tick_unit_;  // the unit that ticks_ were made for
};

}  // namespace taut
