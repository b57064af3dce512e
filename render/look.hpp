#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/camera.hpp"
#include "render/colormap.hpp"

namespace taut::render {

/// Of the width and the height of a picture, pixels.
inline constexpr int least_size = 64;
inline constexpr int greatest_size = 8192;

/// Of a particle as drawn, of its diameter.
inline constexpr double least_glyph = 0.05;
inline constexpr double greatest_glyph = 20;

/// Values of a field, in its unit.
struct Range {
  double low = 0, high = 1;
  bool operator==(const Range&) const = default;
};

/// Pixels.
struct Size {
  int width = 1280, height = 720;
  bool operator==(const Size&) const = default;
};

/// How pictures look. What is none is open: who knows all that they will show chooses it before the first is
/// drawn.
struct Look {
  std::optional<View> view;            // what is seen; in 3D in the plane of the picture
  std::optional<Camera> camera{};      // of scenes in 3D; in 2D there is none
  std::optional<Range> range;          // of the colours; values beyond it take the colour of the end
  const Colormap* colormap = nullptr;  // nullptr: open
  double middle = 0;                   // what a diverging map's middle stands for, if it is in the range
  std::string unit{};                  // of the values: numbers beside the bar have room as they are in it
  std::optional<Size> size = Size{};   // each from least_size to greatest_size
  bool bare = false;                   // particles only, over the whole picture
  double glyph = 1;                    // a particle's diameter as drawn, of its own
  Rgb background = white;              // texts and lines stand out from it
  /// Names of what the values count, from 0: each has a colour of its own, and a legend stands in place of
  /// the bar. Then range and colour map do not matter, and may be open.
  std::vector<std::string> categories{};
};

}  // namespace taut::render
