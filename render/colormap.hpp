#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "render/image/image.hpp"

namespace taut::render {

/// A value that is not a number is drawn in this colour, which is in none of the maps.
inline constexpr Rgb not_a_number_color = {255, 0, 255};

/// A colour map: evenly spaced colours, linear in sRGB in between.
struct Colormap {
  std::string_view key;
  std::string_view help;
  bool diverging;                        // has a neutral middle: for signed fields
  std::span<const std::uint32_t> stops;  // 0xRRGGBB from low to high

  /// The colour at t in [0, 1]; t beyond the ends is clamped, NaN gives the low end.
  Rgb at(double t) const;

  /// 256 colours from low to high, of the part between these two.
  std::array<Rgb, 256> table(double from = 0, double to = 1) const;
};

/// The colour of the `k`-th of some things that have no order; of two near each other in the sequence they
/// differ for colour-blind eyes too. The ninth to the sixteenth are darker, then they come again.
Rgb category_color(std::size_t k);

std::span<const Colormap> colormaps();

/// nullptr if there is none of that name.
const Colormap* find_colormap(std::string_view key);

}  // namespace taut::render
