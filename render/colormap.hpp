#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "render/image/image.hpp"

namespace taut::render {

/// Colour of NaN.
inline constexpr Rgb not_a_number_color = {255, 0, 255};

/// Colours interpolated linearly in sRGB.
struct Colormap {
  std::string_view key;
  std::string_view help;
  bool diverging;
  std::span<const std::uint32_t> stops;  // 0xRRGGBB from low to high

  /// NaN gives the low end.
  Rgb at(double t) const;

  std::array<Rgb, 256> table(double from = 0, double to = 1) const;
};

/// Colours 8 to 15 are darker; then all 16 repeat.
Rgb category_color(std::size_t k);

std::span<const Colormap> colormaps();

/// Returns nullptr for unknown names.
const Colormap* find_colormap(std::string_view key);

}  // namespace taut::render
