#pragma once

#include <memory>
#include <set>
#include <string>

#include <cairo.h>

#include "render/image/image.hpp"
#include "render/page/font.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

// Gray levels, 0 (full contrast) to 1 (background).
inline constexpr double ink = 0.13;
inline constexpr double faint = 0.42;
inline constexpr double cap_height = 0.73;  // of digits, per font size

/// In whole pixels.
double line_width(double em);

/// In pixels from the top left.
class Canvas {
 public:
  enum class Align { left, centre, right };

  /// The image must outlive the canvas and keep its pixels in place.
  explicit Canvas(Image& image, Rgb background = white);

  /// Call before drawing; OpenGL may have drawn on the image.
  void begin();
  void end();

  cairo_t* cairo() { return cairo_.get(); }
  /// 0 (white on dark, black on light) to 1 (background); in transparent pictures, 1 − opacity.
  void gray(double level);
  void color(Rgb color);
  void use(Weight weight, double size);
  void fill(double x, double y, double width, double height);
  /// (x, y): on the baseline.
  void text(const std::string& text, double x, double y, Align align);
  /// (x, y): middle of the baseline.
  void turned_text(const std::string& text, double x, double y);
  double width_of(const std::string& text);
  /// Shortens and records a text that is wider than `room`.
  std::string fitted(std::string text, double room);
  /// Records a text that is not drawn.
  void omit(const std::string& text) { cut_.insert(text); }
  /// Texts that are not drawn in full.
  const std::set<std::string>& cut() const { return cut_; }

 private:
  struct Deleter {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
  };
  Font regular_, bold_;
  Rgb background_;
  std::set<std::string> cut_;
  bool transparent_, erases_ = false;
  double contrast_;  // 0 or 1
  std::unique_ptr<cairo_surface_t, Deleter> surface_;
  std::unique_ptr<cairo_t, Deleter> cairo_;
};

}  // namespace taut::render
