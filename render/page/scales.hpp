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

  /// How much room it needs where it is `height` pixels high and its values are of this unit, em.
  double width(int height, double em, std::string_view unit) const;
  /// At the left of `room`, as high as it. Without numbers where there is no room for them or for what they
  /// are numbers of.
  void draw(Canvas& canvas, const Rect& room, double em, std::string_view field, std::string_view unit);
  /// Arrows at the ends beyond which something lies, in place of those that were drawn before.
  void draw_ends(Canvas& canvas, const Rect& room, double em, Clipped clipped) const;

 private:
  Ticks ticks(int height, double em, std::string_view unit) const;
  void draw_ticks(Canvas& canvas, const Rect& bar, double em) const;

  double low_, high_;
  std::array<Rgb, 256> colors_;
  Ticks ticks_;
  std::string tick_unit_;  // the unit that ticks_ were made for
};

/// "von Mises stress (MPa)" no longer than `room`: the name is shortened, the unit never. Nothing where there
/// is no room for a unit.
std::string label_of_bar(Canvas& canvas, std::string_view field, const std::string& unit, double room);

/// A bar of a round length below a plot, about a fifth of its width.
void draw_scale_bar(Canvas& canvas, const Rect& plot, double pixels_per_metre, double em);

}  // namespace taut::render
