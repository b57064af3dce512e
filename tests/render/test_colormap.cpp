#include <cmath>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "render/colormap.hpp"
#include "render/image/color_space.hpp"
#include "render/renderer.hpp"
#include "tests/support/relative.hpp"

using namespace taut;
using namespace taut::test;
using namespace taut::render;

TEST_SUITE("unit") {
  TEST_CASE("a colour map is found by its key") {
    std::set<std::string_view> keys;
    for (const Colormap& map : colormaps()) {
      CHECK(find_colormap(map.key) == &map);
      CHECK_FALSE(map.help.empty());
      keys.insert(map.key);
    }
    CHECK(keys.size() == colormaps().size());
    CHECK(find_colormap("virids") == nullptr);
  }

  TEST_CASE("the colour maps end with the published colours") {
    struct Ends {
      const char* key;
      Rgb low, high;
    };
    const Ends expected[] = {
        {"viridis", {68, 1, 84}, {253, 231, 37}}, {"plasma", {13, 8, 135}, {240, 249, 33}},
        {"inferno", {0, 0, 4}, {252, 255, 164}},  {"magma", {0, 0, 4}, {252, 253, 191}},
        {"cividis", {0, 34, 78}, {254, 232, 56}}, {"coolwarm", {59, 76, 192}, {180, 4, 38}},
        {"rainbow", {0, 0, 255}, {255, 0, 0}}};
    for (const Ends& ends : expected) {
      CAPTURE(ends.key);
      const Colormap* map = find_colormap(ends.key);
      REQUIRE(map);
      CHECK(map->at(0) == ends.low);
      CHECK(map->at(1) == ends.high);
      CHECK(map->table().front() == ends.low);
      CHECK(map->table().back() == ends.high);
      CHECK(map->at(-0.3) == ends.low);
      CHECK(map->at(7) == ends.high);
      CHECK(map->at(NAN) == ends.low);
    }
  }

  TEST_CASE("colours of viridis between the stops match the published table") {
    struct Entry {
      int index;
      Rgb color;
    };
    const Entry entries[] = {
        {20, {72, 29, 111}}, {60, {61, 78, 138}}, {100, {42, 118, 142}}, {150, {33, 165, 133}}};
    for (const Entry& entry : entries) {
      CAPTURE(entry.index);
      const Rgb color = find_colormap("viridis")->at(entry.index / 255.0);
      for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(color[k] - entry.color[k]) <= 3);
    }
  }

  TEST_CASE("each sequential map except the rainbow grows lighter from end to end") {
    for (const Colormap& map : colormaps()) {
      if (map.diverging || map.key == "rainbow") continue;
      CAPTURE(std::string(map.key));
      const auto table = map.table();
      // rounding can undo a single step
      for (std::size_t i = 8; i < table.size(); ++i) {
        CAPTURE(i);
        CHECK(lab_of(table[i]).L > lab_of(table[i - 8]).L);
      }
      CHECK(lab_of(table.back()).L - lab_of(table.front()).L > 50);
    }
  }

  TEST_CASE("a diverging map is lightest and gray in its middle") {
    for (const Colormap& map : colormaps()) {
      if (!map.diverging) continue;
      CAPTURE(std::string(map.key));
      const Lab middle = lab_of(map.at(0.5));
      CHECK(std::hypot(middle.a, middle.b) < 5);
      for (double t = 0; t < 0.45; t += 0.05) {
        CHECK(lab_of(map.at(t)).L < lab_of(map.at(t + 0.05)).L);
        CHECK(lab_of(map.at(1 - t)).L < lab_of(map.at(0.95 - t)).L);
      }
    }
  }

  TEST_CASE("no map comes near the colour of NaN") {
    for (const Colormap& map : colormaps()) {
      CAPTURE(std::string(map.key));
      for (const Rgb color : map.table()) CHECK(color_difference(color, not_a_number_color) > 30);
    }
  }

  TEST_CASE("the 16 category colours differ from each other and from the colour of NaN") {
    for (std::size_t i = 0; i < 16; ++i) {
      CAPTURE(i);
      CHECK(color_difference(category_color(i), not_a_number_color) > 30);
      for (std::size_t j = 0; j < i; ++j) CHECK(color_difference(category_color(i), category_color(j)) > 12);
    }
    CHECK(category_color(16) == category_color(0));
  }

  TEST_CASE("the middle of a diverging map is visible on white and on black") {
    for (const Colormap& map : colormaps()) {
      if (!map.diverging) continue;
      CHECK(color_difference(map.at(0.5), white) > 20);
      CHECK(color_difference(map.at(0.5), {0, 0, 0}) > 50);
    }
  }

  TEST_CASE("conversion to Lab colours matches reference values") {
    CHECK(lab_of({255, 255, 255}).L == Approx(100).epsilon(1e-4));
    CHECK(lab_of({0, 0, 0}).L == Approx(0));
    const Lab red = lab_of({255, 0, 0});
    CHECK(red.L == Approx(53.24).epsilon(1e-3));
    CHECK(red.a == Approx(80.09).epsilon(1e-3));
    CHECK(red.b == Approx(67.20).epsilon(1e-3));
    CHECK(color_difference({0, 0, 0}, {255, 255, 255}) == Approx(100).epsilon(1e-4));
  }
}
