#pragma once

#include <memory>
#include <string>

#include <cairo.h>

#include "render/image/image.hpp"
#include "render/page/font.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

// Gray levels: 1 is the background, 0 what stands out from it most. Black is too hard on white.
inline constexpr double ink = 0.13;
inline constexpr double faint = 0.42;
inline constexpr double cap_height = 0.73;  // of the digits of DejaVu Sans, per size

/// A hairline that falls on whole pixels.
double line_width(double em);

/// Texts and lines, drawn over an image with Cairo. Pixels from the top left corner.
class Canvas {
 public:
  enum class Align { left, centre, right };

  /// The image must outlive the canvas and keep its pixels where they are.
  explicit Canvas(Image& image, Rgb background = white);

  /// To be called after something else has drawn into the image, and when all is drawn.
  void begin();
  void end();

  cairo_t* cairo() { return cairo_.get(); }
  /// From 0, white on a dark background and black on a light one, to 1, the background.
  void gray(double level);
  void color(Rgb color);
  void use(Weight weight, double size);
  void fill(double x, double y, double width, double height);
  /// Baseline at (x, y).
  void text(const std::string& text, double x, double y, Align align);
  /// Turned to be read from below, its middle at (x, y) of the baseline.
  void turned_text(const std::string& text, double x, double y);
  double width_of(const std::string& text);
  /// Shortened with an ellipsis until it is no wider than `room`.
  std::string fitted(std::string text, double room);

 private:
  struct Deleter {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
  };
  Font regular_, bold_;
  Rgb background_;
  double contrast_;  // 0 or 1: what stands out from the background most
  std::unique_ptr<cairo_surface_t, Deleter> surface_;
  std::unique_ptr<cairo_t, Deleter> cairo_;
};

}  // namespace taut::render
