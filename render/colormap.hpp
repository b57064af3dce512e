#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "render/image/image.hpp"

namespace taut::render {

/// Colour of NaN; no map contains it.
inline constexpr Rgb not_a_number_color = {255, 0, 255};

/// A colour map: evenly spaced colours with linear interpolation in sRGB.
struct Colormap {
  std::string_view key;
  std::string_view help;
  bool diverging;                        // has a neutral middle, for signed fields
  std::span<const std::uint32_t> stops;  // 0xRRGGBB from low to high

  /// Colour at t in [0, 1]; t outside is clamped, NaN gives the low end.
  Rgb at(double t) const;

  /// 256 colours of the part [from, to] of the map.
  std::array<Rgb, 256> table(double from = 0, double to = 1) const;
};

/// Colour of category `k`. Neighbouring colours differ for colour-blind readers too. Colours 8 to 15 are darker;
/// then the sequence repeats.
Rgb category_color(std::size_t k);

std::span<const Colormap> colormaps();

/// nullptr if the name is unknown.
const Colormap* find_colormap(std::string_view key);

}  // namespace taut::render
