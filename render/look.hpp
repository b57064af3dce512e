#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/camera.hpp"
#include "render/colormap.hpp"

namespace taut::render {

/// Of pictures, pixels.
inline constexpr int least_size = 64;
inline constexpr int greatest_size = 8192;

/// Of the drawn over the true diameter.
inline constexpr double least_glyph = 0.05;
inline constexpr double greatest_glyph = 20;

/// In the field's unit.
struct Range {
  double low = 0, high = 1;
  bool operator==(const Range&) const = default;
};

/// Pixels.
struct Size {
  int width = 1280, height = 720;
  bool operator==(const Size&) const = default;
};

/// Appearance of pictures. Open options must be set before drawing.
struct Look {
  std::optional<View> view;            // visible region; in 3D of the picture plane
  std::optional<Camera> camera{};      // only in 3D
  std::optional<Range> range;          // of the colours; values outside are clamped
  const Colormap* colormap = nullptr;  // nullptr: open
  double middle = 0;                   // of a diverging map, if within the range
  std::string unit{};                  // of the values, for the width of their numbers
  std::optional<Size> size = Size{};   // sides from least_size to greatest_size
  bool bare = false;                   // only particles, filling the picture
  double glyph = 1;                    // drawn over true diameter
  Rgb background = white;              // texts and lines contrast with it
  /// If values are category numbers: names from 0, with a legend. Range and colour map may then be open.
  std::vector<std::string> categories{};
};

}  // namespace taut::render
