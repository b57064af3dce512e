#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "render/image/image.hpp"

namespace taut::render {

/// Colour of NaN, which no map contains.
inline constexpr Rgb not_a_number_color = {255, 0, 255};

/// Evenly spaced colours, interpolated linearly in sRGB.
struct Colormap {
  std::string_view key;
  std::string_view help;
  bool diverging;                        // with a neutral middle, for signed fields
  std::span<const std::uint32_t> stops;  // 0xRRGGBB from low to high

  /// Clamps `t` to [0, 1]; NaN gives the low end.
  Rgb at(double t) const;

  /// Samples the part [from, to] of the map, 0 to 1, from low to high.
  std::array<Rgb, 256> table(double from = 0, double to = 1) const;
};

/// Colour of category `k`, from 0. Neighbouring colours differ for colour-blind readers, too. Colours 8 to 15 are
/// darker; then they repeat.
Rgb category_color(std::size_t k);

std::span<const Colormap> colormaps();

/// Returns nullptr for unknown names.
const Colormap* find_colormap(std::string_view key);

}  // namespace taut::render
