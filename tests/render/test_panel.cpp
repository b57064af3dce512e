#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "render/panel.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/synthetic.hpp"

using namespace taut;
using namespace taut::render;
using namespace taut::test;

namespace {

struct Found {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};

/// Bounding box of a colour, left of column `beyond`.
Found find_color(const Image& image, Rgb color, int beyond) {
  Found found;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < beyond; ++column) {
      if (image.at(column, row) != color) continue;
      found.left = std::min(found.left, column), found.right = std::max(found.right, column);
      found.top = std::min(found.top, row), found.bottom = std::max(found.bottom, row);
    }
  }
  return found;
}

PanelOptions two_by_two() {
  PanelOptions options;
  options.look = look(640, 480, {-1, 1, -1, 1});
  options.title = "Discs", options.note = "made up";
  options.field = "speed", options.unit = "m/s";
  options.columns = {{"a", "left"}, {"b", "right"}};
  options.rows = {"t = 1 s", "t = 2 s"};
  return options;
}

FrameView one_disc(Particles& particles, double value) {
  particles.add(0.2, 0.4, 0.6, value);
  return particles.frame();
}

bool same(const Image& a, const Image& b) { return a.pixels == b.pixels; }

}  // namespace

TEST_SUITE("image") {
  TEST_CASE("each picture of a panel is in its row and column, and all have one scale") {
    const PanelOptions options = two_by_two();
    Panel panel(options);
    Particles low, high;
    panel.draw(1, 0, one_disc(low, 0));
    panel.draw(0, 1, one_disc(high, 1));
    const Image& image = panel.finish();
    REQUIRE(image.width == 640);
    REQUIRE(image.height == 480);
    const int before_bar = 500;
    const Found first = find_color(image, options.look.colormap->at(0), before_bar);
    const Found last = find_color(image, options.look.colormap->at(1), before_bar);
    CHECK(first.left > last.right);
    CHECK(first.bottom < last.top);
    CHECK(first.right - first.left == last.right - last.left);
    CHECK(first.bottom - first.top == last.bottom - last.top);
    // the rim is blended
    CHECK(first.right - first.left == Approx(first.bottom - first.top).epsilon(0.05));
  }

  TEST_CASE("texts of a panel are drawn, and the same panel has the same bytes") {
    const auto drawn = [](const PanelOptions& options) { return Image(Panel(options).finish()); };
    const Image all = drawn(two_by_two());
    CHECK(same(all, drawn(two_by_two())));
    PanelOptions other = two_by_two();
    other.title = "Disks";
    CHECK_FALSE(same(all, drawn(other)));
    other = two_by_two(), other.note = "";
    CHECK_FALSE(same(all, drawn(other)));
    other = two_by_two(), other.columns[1].title = "c";
    CHECK_FALSE(same(all, drawn(other)));
    other = two_by_two(), other.columns[1].note = "wrong";
    CHECK_FALSE(same(all, drawn(other)));
    other = two_by_two(), other.rows[1] = "t = 3 s";
    CHECK_FALSE(same(all, drawn(other)));
    other = two_by_two(), other.field = "velocity";
    CHECK_FALSE(same(all, drawn(other)));
    Panel corner(two_by_two()), middle(two_by_two());
    corner.write_corner(0, 1, "t = 2.1 s");
    middle.write_middle(0, 1, "diverged");
    CHECK_FALSE(same(all, corner.finish()));
    CHECK_FALSE(same(all, middle.finish()));
  }

  TEST_CASE("a panel without a size takes its proportions from the view, and a size too small is refused") {
    PanelOptions options = two_by_two();
    options.look.size.reset();
    options.look.view = {0, 4, 0, 1};
    const Image wide = Image(Panel(options).finish());
    CHECK(wide.width > 2 * wide.height);
    options.look.view = {0, 1, 0, 4};
    const Image high = Image(Panel(options).finish());
    CHECK(high.height > 2 * high.width);
    options.look.size = {200, 800};
    CHECK_THROWS_WITH_AS(Panel{options},
                         "a panel of 200x800 pixels is too small for 2 x 2 pictures; use a larger --size",
                         UsageError);
    options.look.size = {800, 200};
    CHECK_THROWS_AS(Panel{options}, UsageError);
  }

  TEST_CASE("a panel with more pixels than the limit is refused") {
    PanelOptions options = two_by_two();
    options.look.size.reset();
    options.rows.assign(20000, "t");
    CHECK_THROWS_WITH_AS(Panel{options}, doctest::Contains("a panel of 2 x 20000 pictures would have"),
                         UsageError);
    CHECK_THROWS_WITH_AS(Panel{options}, doctest::Contains("at most 67 million are allowed"), UsageError);
    options.rows.resize(100), options.width = 500;  // 9 million pixels
    CHECK_THROWS_WITH_AS(Panel{options}, doctest::Contains("16384 per side"), UsageError);
  }

  TEST_CASE(
      "a panel has exactly the given width and a height that suits the view, or is refused as too narrow") {
    PanelOptions options = two_by_two();
    options.look.size.reset();
    options.look.texts.font = 20;
    for (const int width : {500, 1004, 2008}) {
      options.width = width;
      Panel panel(options);
      Particles cover;
      cover.add(0, 0, 4, 0);
      for (const int k : {0, 1}) panel.draw(k, k, cover.frame());
      const Image& image = panel.finish();
      CHECK(image.width == width);
      const int before_bar = width - 140;
      const Found grid = find_color(image, options.look.colormap->at(0), before_bar);
      CHECK(std::abs((grid.right - grid.left) - (grid.bottom - grid.top)) <= 2);  // like the view
      CHECK(grid.right - grid.left > 0.5 * width);
      CHECK(grid.top < 7 * 20);
      CHECK(image.height - grid.bottom < 3 * 20);
    }
    options.width = 200;
    CHECK_THROWS_WITH_AS(Panel{options}, doctest::Contains("has no room for 2 columns"), UsageError);
  }

  TEST_CASE("blocks of a panel have their own colours, and equal colours share a bar") {
    const auto drawn = [](const PanelOptions& options) {
      Panel panel(options);
      Particles first, second;
      for (int column = 0; column < 2; ++column) panel.draw(column, 0, one_disc(first, 0));
      for (int column = 2; column < 4; ++column) panel.draw(column, 0, one_disc(second, 1));
      return Image(panel.finish());
    };
    PanelOptions options = two_by_two();
    options.look.size.reset();
    options.beside = {{options.look, options.field, options.unit}};
    const Image shared = drawn(options);
    const Found low = find_color(shared, options.look.colormap->at(0), shared.width);
    const Found high = find_color(shared, options.look.colormap->at(1), shared.width);
    CHECK(low.left < high.left);
    options.beside.front().look.range = {-9, 1};
    options.beside.front().look.colormap = find_colormap("inferno");
    options.beside.front().field = "pressure";
    const Image own = drawn(options);
    CHECK(own.width > shared.width + 60);  // a second bar
    CHECK(own.height == shared.height);
    const int before_bar = own.width - 150;
    const Found second = find_color(own, find_colormap("inferno")->at(1), before_bar);
    CHECK(second.left > own.width / 2);
    CHECK(second.right > second.left);
    for (const BarPosition bar : {BarPosition::left, BarPosition::bottom}) {
      options.look.texts.bar = bar;
      CHECK_FALSE(same(drawn(options), own));
    }
    options.width = 1200;
    CHECK(drawn(options).width == 1200);
  }

  TEST_CASE("a bare panel on black contains only its pictures and their frames") {
    PanelOptions options = two_by_two();
    options.look.bare = true, options.look.background = {0, 0, 0};
    Panel panel(options);
    Particles disc;
    panel.draw(0, 0, one_disc(disc, 0));
    const Image& image = panel.finish();
    const Found found = find_color(image, {68, 1, 84}, image.width);
    CHECK(found.right - found.left > 60);
    int bright = 0;
    for (int row = 0; row < image.height; ++row)
      for (int column = 0; column < image.width; ++column) bright += image.at(column, row)[0] > 100;
    CHECK(bright == 0);
  }
}
