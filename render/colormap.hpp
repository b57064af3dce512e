#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "render/image/image.hpp"

namespace taut::render {

/// Not contained in any map.
inline constexpr Rgb not_a_number_color = {255, 0, 255};

/// Evenly spaced colours, interpolated in sRGB.
struct Colormap {
  std::string_view key;
  std::string_view help;
  bool diverging;                        // neutral middle, for signed fields
  std::span<const std::uint32_t> stops;  // 0xRRGGBB from low to high

  /// `t` is clamped to [0, 1]; NaN gives the low end.
  Rgb at(double t) const;

  /// Colours in the part [from, to].
  std::array<Rgb, 256> table(double from = 0, double to = 1) const;
};

/// Neighbouring categories differ for colour-blind readers too. Colours 8 to 15 are darker; then they repeat.
Rgb category_color(std::size_t k);

std::span<const Colormap> colormaps();

/// nullptr: unknown.
const Colormap* find_colormap(std::string_view key);

}  // namespace taut::render
