#pragma once

#include <array>
#include <string_view>

#include "render/page/canvas.hpp"
#include "render/page/ticks.hpp"

namespace taut::render {

/// Whether something is drawn in the colour of an end, and lies beyond it.
struct Clipped {
  bool below = false, above = false;
  bool operator==(const Clipped&) const = default;
};

/// The colours from low to high with numbers beside them, and what they stand for.
class ColorBar {
 public:
  /// `colors` are evenly spaced from `low` to `high`.
  ColorBar(double low, double high, const std::array<Rgb, 256>& colors);

  void draw(Canvas& canvas, const Rect& bar, double em, std::string_view field, std::string_view unit);
  /// Arrows at the ends beyond which something lies, in place of those that were drawn before.
  void draw_ends(Canvas& canvas, const Rect& bar, double em, Clipped clipped) const;

 private:
  double low_, high_;
  std::array<Rgb, 256> colors_;
  Ticks ticks_;
  std::string tick_unit_;  // the unit that ticks_ were made for
};

/// A bar of a round length below a plot, about a fifth of its width.
void draw_scale_bar(Canvas& canvas, const Rect& plot, double pixels_per_metre, double em);

}  // namespace taut::render
