#pragma once

#include <array>
#include <string_view>

#include "render/page/canvas.hpp"
#include "render/page/ticks.hpp"

namespace taut::render {

/// What a picture shows that its bar has no place for.
struct OffScale {
  bool below = false, above = false;  // drawn in the colour of an end, and lies beyond it
  bool no_number = false;
  bool operator==(const OffScale&) const = default;
  OffScale& operator|=(const OffScale& other) {
    below |= other.below, above |= other.above, no_number |= other.no_number;
    return *this;
  }
};

/// The colours from low to high with numbers beside them, and what they stand for.
class ColorBar {
 public:
  /// `colors` are evenly spaced from `low` to `high`; what is no number has a colour of its own.
  ColorBar(double low, double high, const std::array<Rgb, 256>& colors, Rgb no_number);

  /// How much room it needs where it is `height` pixels high and its values are of this unit, em.
  double width(int height, double em, std::string_view unit) const;
  /// At the left of `room`, as high as it. Without numbers where there is no room for them or for what they
  /// are numbers of.
  void draw(Canvas& canvas, const Rect& room, double em, std::string_view field, std::string_view unit);
  /// Arrows at the ends beyond which something lies, and below what is no number, in place of what was drawn
  /// before.
  void draw_off_scale(Canvas& canvas, const Rect& room, double em, const OffScale& found) const;

 private:
  Ticks ticks(int height, double em, std::string_view unit) const;
  void draw_ticks(Canvas& canvas, const Rect& bar, double em) const;

  double low_, high_;
  std::array<Rgb, 256> colors_;
  Rgb no_number_;
  Ticks ticks_;
  std::string tick_unit_;  // the unit that ticks_ were made for
};

/// "von Mises stress (MPa)" no longer than `room`: the name is shortened, the unit never. Nothing where there
/// is no room for a unit.
std::string label_of_bar(Canvas& canvas, std::string_view field, const std::string& unit, double room);

/// A bar of a round length below a plot, about a fifth of its width.
void draw_scale_bar(Canvas& canvas, const Rect& plot, double pixels_per_metre, double em);

}  // namespace taut::render
