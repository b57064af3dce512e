#include <algorithm>

#include <doctest/doctest.h>

#include "render/page/page_layout.hpp"
#include "render/renderer.hpp"
#include "tests/support/relative.hpp"

using namespace taut;
using namespace taut::test;
using namespace taut::render;

TEST_SUITE("unit") {
  TEST_CASE("the plot holds the whole view, in its middle, and touches it on two sides") {
    const View views[] = {{-1, 1, -1, 1}, {0, 3, 10, 10.5}, {-0.1, 0, 0, 7}};
    const int sizes[] = {64, 90, 180, 720, 1080, 4000, 8192};
    for (const View& view : views) {
      for (const int width : sizes) {
        for (const int height : sizes) {
          CAPTURE(width);
          CAPTURE(height);
          const PageLayout layout = make_layout(width, height, view);
          const double left = layout.column(view.x_min);
          const double right = layout.column(view.x_max);
          const double top = layout.row(view.y_max);
          const double bottom = layout.row(view.y_min);
          CHECK(left >= -1e-6);
          CHECK(right <= layout.plot.width + 1e-6);
          CHECK(top >= -1e-6);
          CHECK(bottom <= layout.plot.height + 1e-6);
          const double spare = std::min(left, top);
          CHECK(spare == Approx(0).scale(1).epsilon(1e-6));
          CHECK(left == Approx(layout.plot.width - right).scale(1).epsilon(1e-6));
          CHECK(top == Approx(layout.plot.height - bottom).scale(1).epsilon(1e-6));
        }
      }
    }
  }

  TEST_CASE("plot and colour bar lie in the picture, side by side, at any size") {
    for (int width = least_size; width <= greatest_size; width += width / 7) {
      for (int height = least_size; height <= greatest_size; height += height / 7) {
        CAPTURE(width);
        CAPTURE(height);
        const PageLayout layout = make_layout(width, height, {0, 1, 0, 1});
        CHECK(layout.plot.x >= 0);
        CHECK(layout.plot.y >= 0);
        CHECK(layout.plot.width * 2 > width);
        CHECK(layout.plot.height * 2 > height);
        CHECK(layout.plot.y + layout.plot.height <= height);
        if (layout.font == 0) {
          CHECK(layout.plot.width == width);
          continue;
        }
        CHECK(layout.plot.x + layout.plot.width < layout.key.x);
        CHECK(layout.key.width >= 8);
        CHECK(layout.key.x + layout.key.width <= layout.right + 1);
        CHECK(layout.right < width);
      }
    }
  }
}
