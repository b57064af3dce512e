#include <string>

#include <doctest/doctest.h>

#include "render/panel.hpp"
#include "tests/support/synthetic.hpp"

using namespace taut;
using namespace taut::render;
using namespace taut::test;

namespace {

/// Number of non-white pixels from column `left`, above row `bottom`.
int painted_from(const Image& image, int left, int bottom) {
  int count = 0;
  for (int row = 0; row < bottom; ++row)
    for (int column = left; column < image.width; ++column) count += image.at(column, row) != white;
  return count;
}

}  // namespace

TEST_SUITE("image") {
  TEST_CASE("the label of a bar is shortened in its name, and keeps its unit and power of ten") {
    const Particles none;
    FrameView frame = none.frame();
    const std::string name(80, 'x');
    frame.field = name;
    Look with = look(320, 180, unit_view);
    const auto drawn = [&](double factor, std::string_view unit) {
      with.range = {0, factor}, frame.unit = unit;
      return Image(Renderer(with).draw(frame));
    };
    for (const std::string_view unit : {"", "1/s"}) CHECK_FALSE(drawn(1e6, unit) == drawn(1e9, unit));
    CHECK_FALSE(drawn(1, "kg/m³") == drawn(1, "1/s"));
    CHECK_FALSE(drawn(1e6, "Pa") == drawn(1e3, "Pa"));
    const PageLayout layout = make_layout(320, 180, unit_view);
    const Image image = drawn(1e6, "kg/m³");
    int beyond = 0;
    for (int row = layout.key.y + layout.key.height + 4; row < 180; ++row)
      for (int column = layout.key.x + 20; column < 320; ++column) beyond += image.at(column, row) != white;
    CHECK(beyond == 0);
  }

  TEST_CASE("a bar whose unit does not fit has no numbers") {
    Particles none;
    FrameView frame = none.frame();
    frame.field = "von Mises stress",
    frame.unit = std::string_view("a unit that is as long as no unit ever was");
    const Look with = look(320, 180, unit_view);
    Renderer renderer(with);
    const PageLayout layout = make_layout(320, 180, unit_view);
    const int beside_bar = layout.key.x + static_cast<int>(std::lround(1.15 * layout.font));
    const Image& image = renderer.draw(frame);
    int painted = 0;
    for (int row = layout.key.y; row < layout.key.y + layout.key.height; ++row)
      for (int column = beside_bar; column < 320; ++column) painted += image.at(column, row) != white;
    CHECK(painted == 0);
  }

  TEST_CASE("wide numbers and the label of a bar leave the right margin of the picture white") {
    Particles none;
    const auto right_of = [&](const Range& range, std::string_view unit, int width, int height) {
      Look with = look(width, height, unit_view);
      with.range = range, with.unit = unit;
      FrameView frame = none.frame();
      frame.field = "density", frame.unit = unit;
      const Image image = Renderer(with).draw(frame);
      const double em = text_size(width, height).font;
      return painted_from(image, static_cast<int>(width - 0.7 * em), height);
    };
    for (const auto& [width, height] : {std::pair(320, 180), {640, 360}, {1280, 720}, {240, 400}}) {
      CHECK(right_of({1200, 1200.06}, "kg/m³", width, height) == 0);
      CHECK(right_of({-1000.004, -1000}, "kg/m³", width, height) == 0);
      CHECK(right_of({0.0100001, 0.0100002}, "", width, height) == 0);
    }
  }

  TEST_CASE(
      "a bar below the plot runs from low at the left to high at the right, with arrows at exceeded ends") {
    Particles particles;
    for (const auto& [x, value] : {std::pair(0.2, -5.0), {0.8, 5.0}}) particles.add(x, 0.5, 0.01, value);
    Look with = look(640, 360, unit_view);
    with.texts.bar = BarPosition::bottom;
    const PageLayout layout = make_layout(640, 360, unit_view, true, room_of_bar, with.texts);
    const Image image = Renderer(with).draw(particles.frame());
    // the row is above the tips of the arrows
    const int row = layout.key.y, end = layout.key.x + layout.key.width;
    int lowest = 0, highest = 0;
    for (int column = 0; column < 640; ++column) {
      if (image.at(column, row) == with.colormap->at(0) && lowest == 0) lowest = column;
      if (image.at(column, row) == with.colormap->at(1)) highest = column;
    }
    CHECK(lowest > 0);
    CHECK(highest - lowest > (end - layout.key.x) / 2);
    CHECK(painted_from(image, static_cast<int>(640 - 0.7 * layout.font), 360) == 0);
    const auto beyond = [&](int from, int to) {
      int painted = 0;
      for (int column = from; column < to; ++column)
        painted += image.at(column, layout.key.y + 5) != Rgb{255, 255, 255};
      return painted;
    };
    CHECK(beyond(lowest - 10, lowest - 2) > 0);
    CHECK(beyond(highest + 3, highest + 10) > 0);
  }

  TEST_CASE("a panel has room for wide numbers") {
    PanelOptions options;
    options.columns = {{"a", ""}}, options.rows = {"t = 1 s"};
    options.field = "density", options.unit = "kg/m³";
    for (const std::optional<Size> size : {std::optional(Size{640, 360}), std::optional<Size>()}) {
      options.look = look(640, 360, unit_view);
      options.look.range = {1200, 1200.06}, options.look.size = size;
      const Image image = Panel(options).finish();
      CHECK(painted_from(image, image.width - 3, image.height) == 0);
    }
  }
}
