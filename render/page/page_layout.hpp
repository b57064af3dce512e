#pragma once

#include <array>
#include <cstdint>

#include "render/image/image.hpp"

namespace taut::render {

/// Visible region, m; extended to the aspect ratio of the plot.
struct View {
  double x_min = 0, x_max = 1, y_min = 0, y_max = 1;
  bool operator==(const View&) const = default;
};

/// Unit vectors of the scene's axes; components to the right, up and towards the viewer.
using AxesMarker = std::array<std::array<double, 3>, 3>;

struct PageLayout {
  double font = 0;  // em in pixels; 0: no texts
  Rect plot;
  Rect key;
  double left = 0, right = 0;  // ends of the header, pixels
  double pixels_per_metre = 1;
  double x_origin = 0, y_origin = 0;  // of the scene, from the plot's top left, pixels

  double column(double x) const { return x_origin + x * pixels_per_metre; }
  double row(double y) const { return y_origin - y * pixels_per_metre; }  // downwards
};

struct TextParts {
  bool title = true, method = true, time = true;
  bool bar = true;  // or legend
  bool scale = true, axes = true;
  bool operator==(const TextParts&) const = default;

  bool header() const { return title || method || time; }
};

enum class BarPosition : std::uint8_t { right, left, bottom };

/// Minimum width of a colour key beside the plot, and height of a key below it, em.
inline constexpr double room_of_bar = 5.75, room_of_bar_below = 4.2;
/// Height and width of axes below the plot, em.
inline constexpr double room_of_axes = 5.2;

struct PageTexts {
  double font = 0;  // pixels; 0: by the picture's size
  TextParts parts{};
  BarPosition bar = BarPosition::right;
  bool axes_outside = false;  // below the plot

  bool has_bar(BarPosition position) const { return parts.bar && bar == position; }
};

/// Sizes in pixels; 0: no texts.
struct TextSize {
  double font = 0;
  int key_height = 0;
};
TextSize text_size(int width, int height, const PageTexts& texts = {});

/// `room`: width of a key beside the plot, em.
PageLayout make_layout(int width, int height, const View& view, bool with_texts = true,
                       double room = room_of_bar, const PageTexts& texts = {});

}  // namespace taut::render
