#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/camera.hpp"
#include "render/colormap.hpp"
#include "render/page/ticks.hpp"

namespace taut::render {

/// Sides of a picture, pixels.
inline constexpr int least_size = 64;
inline constexpr int greatest_size = 8192;

/// Drawn / true diameter.
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

/// Before drawing, `view` and `size` must be set, and `categories` or both `range` and `colormap`.
struct Look {
  std::optional<View> view;
  std::optional<Camera> camera{};  // 3D
  std::optional<Range> range;      // values outside are clamped
  const Colormap* colormap = nullptr;
  double middle = 0;  // value at the middle of a diverging map
  std::string unit{};
  std::optional<Size> size = Size{};
  bool bare = false;  // no texts
  PageTexts texts{};
  NumberFormat bar_format{};
  double glyph = 1;
  Rgb background = white;  // texts contrast with it
  bool transparent = false;
  /// If not empty, values are indices of categories.
  std::vector<std::string> categories{};
  std::vector<int> unlisted{};  // categories without an entry in the legend
};

}  // namespace taut::render
