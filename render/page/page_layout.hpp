#pragma once

#include <array>

#include "render/image/image.hpp"

namespace taut::render {

/// Minimum visible region in scene coordinates, m. The picture extends it along one axis, since both axes have the
/// same scale.
struct View {
  double x_min = 0, x_max = 1, y_min = 0, y_max = 1;
  bool operator==(const View&) const = default;
};

/// Unit vectors of a 3D scene's axes x, y, z in the picture: components to the right, up and towards the viewer.
using AxesMarker = std::array<std::array<double, 3>, 3>;

/// Positions of the parts of a picture.
struct PageLayout {
  double font = 0;   // em in pixels; 0: the picture is too small for texts
  Rect plot;         // the particles
  Rect key;          // colour bar with its numbers, or legend
  double right = 0;  // right end of the texts, pixels
  double pixels_per_metre = 1;
  double x_origin = 0, y_origin = 0;  // scene origin, pixels from the plot's top left corner

  double column(double x) const { return x_origin + x * pixels_per_metre; }  // in the plot
  double row(double y) const { return y_origin - y * pixels_per_metre; }     // in the plot, downwards
};

/// Minimum width of a colour bar with numbers and label, em.
inline constexpr double room_of_bar = 5.75;

/// Font size and height of the colour bar or legend, pixels; both 0 if the picture is too small for texts.
struct TextSize {
  double font = 0;
  int key_height = 0;
};
TextSize text_size(int width, int height);

/// Without `texts`, or if the picture is too small for them, the plot fills it. The bar or legend is `room` em wide,
/// but at most 36 % of the picture.
PageLayout make_layout(int width, int height, const View& view, bool texts = true, double room = room_of_bar);

}  // namespace taut::render
