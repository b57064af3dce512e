#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/frame_view.hpp"
#include "render/renderer.hpp"

namespace taut::test {

using namespace render;

struct Particles {
  std::vector<double> x, diameter, value;

  void add(double px, double py, double d, double v) {
    x.push_back(px), x.push_back(py), diameter.push_back(d), value.push_back(v);
  }
  FrameView frame() const {
    FrameView frame;
    frame.x = x, frame.diameter = diameter, frame.value = value;
    frame.time = 0.005004;
    frame.field = "von Mises stress", frame.unit = "Pa";
    frame.title = "Two rings", frame.method = "enog";
    return frame;
  }
};

inline void add_ring(Particles& particles, double centre, double dp) {
  for (double a = -0.04 + 0.5 * dp; a < 0.04; a += dp) {
    for (double b = -0.04 + 0.5 * dp; b < 0.04; b += dp) {
      const double r = std::hypot(a, b);
      if (r < 0.03 || r > 0.04) continue;
      particles.add(centre + a, b, dp, 0.5 + 0.5 * std::cos(3 * std::atan2(b, a)));
    }
  }
}

inline Particles two_rings() {
  Particles particles;
  add_ring(particles, -0.045, 0.002);
  add_ring(particles, 0.045, 0.002);
  return particles;
}

inline Look look(int width, int height, View view) {
  return {
      .view = view, .range = Range{0, 1}, .colormap = find_colormap("viridis"), .size = Size{width, height}};
}

inline constexpr View unit_view = {-1, 1, -1, 1};
inline constexpr View rings_view = {-0.09, 0.09, -0.05, 0.05};

inline Rgb color_at(const Image& image, const View& view, double x, double y) {
  const PageLayout layout = make_layout(image.width, image.height, view);
  return image.at(layout.plot.x + static_cast<int>(std::floor(layout.column(x))),
                  layout.plot.y + static_cast<int>(std::floor(layout.row(y))));
}

}  // namespace taut::test
