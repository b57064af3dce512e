#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/camera.hpp"
#include "render/colormap.hpp"

namespace taut::render {

/// Bounds of a picture's width and height, pixels.
inline constexpr int least_size = 64;
inline constexpr int greatest_size = 8192;

/// Bounds of the drawn diameter, in particle diameters.
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

/// Appearance of pictures. An empty option is open; the caller must set it before the first picture is drawn.
struct Look {
  std::optional<View> view;            // visible part of the scene; in 3D of the picture plane
  std::optional<Camera> camera{};      // only of 3D scenes
  std::optional<Range> range;          // of the colours; values outside get the colour of the end
  const Colormap* colormap = nullptr;  // nullptr: open
  double middle = 0;                   // value of a diverging map's middle, if within the range
  std::string unit{};                  // of the values; the layout reserves space for numbers in this unit
  std::optional<Size> size = Size{};   // width and height from least_size to greatest_size
  bool bare = false;                   // particles only, filling the whole picture
  double glyph = 1;                    // drawn diameter, in particle diameters
  Rgb background = white;              // texts and lines contrast with it
  /// Names of categories, if values are category numbers from 0. Each has its own colour and a legend replaces the
  /// bar; range and colour map are ignored and may be open.
  std::vector<std::string> categories{};
};

}  // namespace taut::render
