#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "render/panel.hpp"
#include "render/renderer.hpp"
#include "tests/support/synthetic.hpp"

using namespace taut;
using namespace taut::render;
using namespace taut::test;

namespace {

Particles particle(double x, double y, double diameter, double value) {
  Particles particles;
  particles.add(x, y, diameter, value);
  return particles;
}

Image picture(const Particles& particles, const Look& with) { return Renderer(with).draw(particles.frame()); }

}  // namespace

TEST_SUITE("image") {
  TEST_CASE(
      "a diverging map has its middle at 0, or at what else it diverges from, in any range that holds it") {
    const Colormap& coolwarm = *find_colormap("coolwarm");
    struct Case {
      Range range;
      double middle, value, t;  // where in the map
    };
    for (const auto& [range, middle, value, t] : {Case{{-1e6, 4e6}, 0, 0, 0.5},
                                                  {{-1e6, 4e6}, 0, 4e6, 1},
                                                  {{-1e6, 4e6}, 0, 1e6, 0.625},
                                                  {{-1e6, 4e6}, 0, -1e6, 0.375},
                                                  {{-1e6, 4e6}, 0, -3e6, 0.375},  // of the end
                                                  {{-4, 1}, 0, -4, 0},
                                                  {{0.5, 3}, 1, 1, 0.5},
                                                  {{0.5, 3}, 1, 0.5, 0.375},
                                                  {{-0.5, 2.5}, 1, 1, 0.5},
                                                  {{0, 4}, 0, 0, 0},  // lies to no side of it
                                                  {{2, 4}, 0, 2, 0},
                                                  {{-3, 3}, 0, -3, 0},
                                                  {{-3, 3}, 0, 1.5, 0.75}}) {
      const std::pair range_and_value(range.low, value);  // clang captures no bindings
      CAPTURE(range_and_value.first);
      CAPTURE(range_and_value.second);
      Look with = look(640, 360, unit_view);
      with.colormap = &coolwarm, with.range = range, with.middle = middle;
      const Image image = picture(particle(0, 0, 0.4, value), with);
      const PageLayout layout = make_layout(640, 360, unit_view);
      const double share = std::clamp((value - range.low) / (range.high - range.low), 0.0, 1.0);
      const int row = layout.key.y + static_cast<int>(std::lround((1 - share) * (layout.key.height - 1)));
      const Rgb color = coolwarm.at(t);
      for (const Rgb& seen : {color_at(image, unit_view, 0, 0), image.at(layout.key.x + 4, row)})
        for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(seen[k] - color[k]) <= 3);  // 256 colours a range
    }
    Look with = look(100, 100, unit_view);  // other maps go from end to end
    with.range = {-1, 4};
    CHECK(color_at(picture(particle(0, 0, 0.4, -1), with), unit_view, 0, 0) == with.colormap->at(0));
  }
}
