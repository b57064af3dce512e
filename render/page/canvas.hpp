#pragma once

#include <memory>
#include <string>

#include <cairo.h>

#include "render/image/image.hpp"
#include "render/page/font.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

// Gray levels: 1 is the background, 0 the strongest contrast. Pure black is too hard on white.
inline constexpr double ink = 0.13;
inline constexpr double faint = 0.42;
inline constexpr double cap_height = 0.73;  // of the digits of DejaVu Sans, relative to the font size

/// Width of a thin line, in whole pixels.
double line_width(double em);

/// Draws texts and lines over an image with Cairo. Coordinates are pixels from the top left corner.
class Canvas {
 public:
  enum class Align { left, centre, right };

  /// The image must outlive the canvas and must not move its pixels.
  explicit Canvas(Image& image, Rgb background = white);

  /// `begin` must follow any other drawing into the image; `end` completes the drawing.
  void begin();
  void end();

  cairo_t* cairo() { return cairo_.get(); }
  /// Sets a gray level, from 0 (white on a dark background, black on a light one) to 1 (the background).
  void gray(double level);
  void color(Rgb color);
  void use(Weight weight, double size);
  void fill(double x, double y, double width, double height);
  /// Draws text with its baseline at (x, y).
  void text(const std::string& text, double x, double y, Align align);
  /// Draws text upwards, with the middle of its baseline at (x, y).
  void turned_text(const std::string& text, double x, double y);
  double width_of(const std::string& text);
  /// Shortens text with an ellipsis to the width `room`.
  std::string fitted(std::string text, double room);

 private:
  struct Deleter {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
  };
  Font regular_, bold_;
  Rgb background_;
  double contrast_;  // 0 or 1: the strongest contrast to the background
  std::unique_ptr<cairo_surface_t, Deleter> surface_;
  std::unique_ptr<cairo_t, Deleter> cairo_;
};

}  // namespace taut::render
