#include <algorithm>
#include <cstdlib>

#include <doctest/doctest.h>

#include "render/page/page_layout.hpp"
#include "render/renderer.hpp"
#include "tests/support/relative.hpp"

using namespace taut;
using namespace taut::test;
using namespace taut::render;

TEST_SUITE("unit") {
  TEST_CASE("the plot contains the whole view in its middle, and both have the same width or height") {
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

  TEST_CASE(
      "the plot takes the place of texts that are left out, and a chosen font is used in small pictures") {
    const View view{0, 1, 0, 1};
    const PageLayout all = make_layout(640, 360, view);
    const auto with = [&](const TextParts& parts) {
      return make_layout(640, 360, view, true, room_of_bar, {.parts = parts}).plot;
    };
    const Rect no_header = with({.title = false, .method = false, .time = false});
    CHECK(no_header.y < all.plot.y);
    CHECK(no_header.y + no_header.height == all.plot.y + all.plot.height);
    CHECK(with({.title = false}).y == all.plot.y);  // time and method still need this line
    CHECK(with({.scale = false}).height > all.plot.height);
    const Rect no_bar = with({.bar = false});
    CHECK(no_bar.width > all.plot.width + 3 * all.font);
    CHECK(no_bar.x + no_bar.width <= 640);
    CHECK(make_layout(200, 150, view).font == 0);
    CHECK(make_layout(200, 150, view, true, room_of_bar, {.font = 11}).font == 11);
    CHECK(make_layout(640, 360, view, true, room_of_bar, {.font = all.font}).plot.width == all.plot.width);
  }

  TEST_CASE("the plot, a colour bar left of it or below it, and axes below it leave room for each other") {
    const View view{0, 1, 0, 1};
    const PageLayout all = make_layout(640, 360, view);
    const auto with = [&](const PageTexts& texts) {
      return make_layout(640, 360, view, true, room_of_bar, texts);
    };
    const PageLayout left = with({.bar = BarPosition::left});
    CHECK(left.key.x == all.plot.x);
    CHECK(left.key.x + left.key.width < left.plot.x);
    CHECK(std::abs(left.plot.width - all.plot.width) <= 1);  // rounding
    CHECK(left.left == all.left);
    const PageLayout below = with({.bar = BarPosition::bottom});
    CHECK(below.plot.width > all.plot.width + 5 * all.font);
    CHECK(below.plot.y + below.plot.height + 2 * all.font < below.key.y);  // for the scale bar
    CHECK(below.key.y + below.key.height == 360);
    CHECK(below.key.width == below.plot.width);
    const PageLayout axes = with({.axes_outside = true});
    CHECK(axes.plot.height < all.plot.height - 2 * all.font);
    CHECK(with({.parts = {.axes = false}, .axes_outside = true}).plot.height == all.plot.height);
    const PageLayout both = with({.bar = BarPosition::bottom, .axes_outside = true});
    CHECK(both.plot.height == below.plot.height);
    CHECK(both.key.x + both.key.width < both.plot.x + both.plot.width - 5 * all.font);
  }

  TEST_CASE("the plot lies in the picture, left of any colour bar, at sizes from 64 to 8192 pixels") {
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
