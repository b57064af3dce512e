#pragma once

#include <array>
#include <string_view>

#include "render/page/canvas.hpp"
#include "render/page/ticks.hpp"

namespace taut::render {

struct OffScale {
  bool below = false, above = false;  // values drawn in the colour of an end
  bool no_number = false;
  bool operator==(const OffScale&) const = default;
  OffScale& operator|=(const OffScale& other) {
    below |= other.below, above |= other.above, no_number |= other.no_number;
    return *this;
  }
};

class ColorBar {
 public:
  /// `across`: from left to right.
  ColorBar(double low, double high, const std::array<Rgb, 256>& colors, Rgb no_number,
           const NumberFormat& format = {}, bool across = false);

  /// Width in em of an upright bar, for a height in pixels.
  double width(int height, double em, std::string_view unit) const;
  /// May omit label and numbers for lack of room.
  void draw(Canvas& canvas, const Rect& room, double em, std::string_view field, std::string_view unit);
  /// Replaces the arrows at exceeded ends and the swatch for NaN.
  void draw_off_scale(Canvas& canvas, const Rect& room, double em, const OffScale& found) const;

 private:
  Ticks ticks(int length, double em, std::string_view unit) const;
  Rect bar_in(const Rect& room, double em) const;
  void draw_upright(Canvas& canvas, const Rect& room, const Rect& bar, double em,
                    std::string_view field) const;
  void draw_across(Canvas& canvas, const Rect& bar, double em, std::string_view field) const;
  void draw_ticks(Canvas& canvas, const Rect& bar, double em) const;

  double low_, high_;
  std::array<Rgb, 256> colors_;
  Rgb no_number_;
  NumberFormat format_;
  bool across_;
  Ticks ticks_;
  std::string tick_unit_;
};

/// "von Mises stress (MPa)", at most `room` pixels long; shortens the name. May be empty.
std::string label_of_bar(Canvas& canvas, std::string_view field, const std::string& unit, double room);

void draw_scale_bar(Canvas& canvas, const Rect& plot, double pixels_per_metre, double em);

}  // namespace taut::render
