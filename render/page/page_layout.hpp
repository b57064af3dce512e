#pragma once

#include <array>

#include "render/image/image.hpp"

namespace taut::render {

/// What must be seen, in the coordinates of the scene (m). The picture shows more along one of the axes,
/// since a metre is as long on the one as on the other.
struct View {
  double x_min = 0, x_max = 1, y_min = 0, y_max = 1;
  bool operator==(const View&) const = default;
};

/// The axes x, y, z of a scene in 3D as they stand in a picture: of length 1, to the right, up and towards
/// who looks at it.
using AxesMarker = std::array<std::array<double, 3>, 3>;

/// Where things are in a picture.
struct PageLayout {
  double font = 0;   // height of an em in pixels; 0 = the picture is too small for text and a colour bar
  Rect plot;         // the particles
  Rect key;          // what the colours mean: a bar with its numbers, or a legend
  double right = 0;  // where the texts end, pixels
  double pixels_per_metre = 1;
  double x_origin = 0, y_origin = 0;  // of the scene's origin, in pixels from the plot's top left corner

  double column(double x) const { return x_origin + x * pixels_per_metre; }  // in the plot
  double row(double y) const { return y_origin - y * pixels_per_metre; }     // in the plot, downwards
};

/// What a colour bar has at least for its numbers and its label, em.
inline constexpr double room_of_bar = 5.75;

/// Of the texts, in pixels, and how high what says what the colours mean is then; both 0 in a picture too
/// small for them.
struct TextSize {
  double font = 0;
  int key_height = 0;
};
TextSize text_size(int width, int height);

/// Without `texts`, or in a picture too small for them, the plot is all of it. What says what the colours
/// mean has `room` em, but no more than a good third of the width.
PageLayout make_layout(int width, int height, const View& view, bool texts = true, double room = room_of_bar);

}  // namespace taut::render
