#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/camera.hpp"
#include "render/colormap.hpp"

namespace taut::render {

/// Picture sides, pixels.
inline constexpr int least_size = 64;
inline constexpr int greatest_size = 8192;

/// Ratio drawn / true diameter.
inline constexpr double least_glyph = 0.05;
inline constexpr double greatest_glyph = 20;

struct Range {
  double low = 0, high = 1;
  bool operator==(const Range&) const = default;
};

struct Size {
  int width = 1280, height = 720;
  bool operator==(const Size&) const = default;
};

/// Appearance of pictures. Members without a value are open, and must be set before drawing.
struct Look {
  std::optional<View> view;
  std::optional<Camera> camera{};      // only in 3D
  std::optional<Range> range;          // values outside are clamped
  const Colormap* colormap = nullptr;  // nullptr: open
  double middle = 0;                   // value of a diverging map's middle, if in range
  std::string unit{};                  // of the values; determines the width of their numbers
  std::optional<Size> size = Size{};   // sides from least_size to greatest_size
  bool bare = false;                   // only particles, over the whole picture
  PageTexts texts{};                   // unless bare
  double glyph = 1;                    // drawn / true diameter
  Rgb background = white;              // texts contrast with it
  bool transparent = false;            // draws no background
  /// Names of categories; values then count from 0, a legend replaces the bar, range and colour map may be open.
  std::vector<std::string> categories{};
};

}  // namespace taut::render
