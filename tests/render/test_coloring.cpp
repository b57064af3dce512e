#include <algorithm>
#include <cmath>
#include <vector>

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
  TEST_CASE("a diverging map has its middle colour at `middle` if this value lies inside the range") {
    const Colormap& coolwarm = *find_colormap("coolwarm");
    struct Case {
      Range range;
      double middle, value, t;  // t: place in the map
    };
    for (const auto& [range, middle, value, t] : {Case{{-1e6, 4e6}, 0, 0, 0.5},
                                                  {{-1e6, 4e6}, 0, 4e6, 1},
                                                  {{-1e6, 4e6}, 0, 1e6, 0.625},
                                                  {{-1e6, 4e6}, 0, -1e6, 0.375},
                                                  {{-1e6, 4e6}, 0, -3e6, 0.375},
                                                  {{-4, 1}, 0, -4, 0},
                                                  {{0.5, 3}, 1, 1, 0.5},
                                                  {{0.5, 3}, 1, 0.5, 0.375},
                                                  {{-0.5, 2.5}, 1, 1, 0.5},
                                                  {{0, 4}, 0, 0, 0},
                                                  {{2, 4}, 0, 2, 0},
                                                  {{-3, 3}, 0, -3, 0},
                                                  {{-3, 3}, 0, 1.5, 0.75}}) {
      const std::pair range_and_value(range.low, value);
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
        for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(seen[k] - color[k]) <= 3);
    }
    Look with = look(100, 100, unit_view);
    with.range = {-1, 4};
    CHECK(color_at(picture(particle(0, 0, 0.4, -1), with), unit_view, 0, 0) == with.colormap->at(0));
  }

  TEST_CASE(
      "only particles in the picture put an arrow at the bar's end, in 2D and 3D, with cells, and in a panel") {
    const PageLayout layout = make_layout(640, 360, unit_view);
    const int middle = layout.key.x + static_cast<int>(0.5 * 1.15 * layout.font), above = layout.key.y - 4;
    const std::vector<double> cell{0.1, 0, 0, 0.1}, cell_in_space{0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1};
    for (const bool seen : {true, false})
      for (const int dim : {2, 3})
        for (const bool cells : {false, true}) {
          CAPTURE(dim);
          CAPTURE(cells);
          const std::vector<double> x{seen ? 0.0 : 9.0, 0, 0}, diameter{0.1}, value{2};
          FrameView frame;
          frame.dim = dim, frame.x = std::span(x).first(static_cast<std::size_t>(dim));
          frame.diameter = diameter, frame.value = value;
          if (cells) frame.cell = dim == 2 ? cell : cell_in_space;
          Look with = look(640, 360, unit_view);
          if (dim == 3) with.camera = Camera{.from = {0, 0, 1}, .up = {0, 1, 0}};
          CHECK((Renderer(with).draw(frame).at(middle, above) == with.colormap->at(1)) == seen);
          if (dim == 3 || cells) continue;
          PanelOptions options;
          options.look = with, options.columns = {{"a", ""}}, options.rows = {"t = 1 s"};
          Panel empty(options), panel(options);
          panel.draw(0, 0, frame);
          CHECK((panel.finish() == empty.finish()) == !seen);
        }
  }

  TEST_CASE("the colour of NaN is explained below the bar if the picture contains NaN") {
    const Look with = look(640, 360, unit_view);
    const PageLayout layout = make_layout(640, 360, unit_view);
    const int bottom = layout.key.y + layout.key.height + 6;
    const Rect below{layout.key.x, bottom, 640 - layout.key.x, 360 - bottom};
    struct Found {
      int swatch = 0, other = 0, at_edge = 0;
    };
    const auto key_of = [&](const Image& image) {
      Found found;
      for (int row = below.y; row < below.y + below.height; ++row)
        for (int column = below.x; column < 640; ++column) {
          const Rgb color = image.at(column, row);
          found.swatch += color == not_a_number_color;
          found.other += color != white && color != not_a_number_color;
          found.at_edge += color != white && column > 637;
        }
      return found;
    };
    const Image some = picture(particle(0, 0, 0.1, NAN), with),
                none = picture(particle(0, 0, 0.1, 0.5), with);
    CHECK(key_of(some).swatch >= 30);
    CHECK(key_of(some).other > 30);
    CHECK(key_of(some).at_edge == 0);
    CHECK(key_of(none).swatch + key_of(none).other == 0);
    CHECK(key_of(picture(particle(9, 0, 0.1, NAN), with)).swatch == 0);
    int elsewhere = 0;
    for (int row = 0; row < below.y; ++row)
      for (int column = layout.plot.x + layout.plot.width; column < 640; ++column)
        elsewhere += some.at(column, row) != none.at(column, row);
    CHECK(elsewhere == 0);
    Renderer renderer(with);
    for (const double value : std::vector<double>{NAN, 0.5, NAN, -3}) {
      const Particles one = particle(0, 0, 0.1, value);
      CHECK(renderer.draw(one.frame()) == picture(one, with));
    }
    PanelOptions options;
    options.look = with, options.columns = {{"a", ""}}, options.rows = {"t = 1 s"};
    options.look.size.reset();
    Panel panel(options);
    const Particles one = particle(0, 0, 0.1, NAN);
    panel.draw(0, 0, one.frame());
    const Image& image = panel.finish();
    int swatch = 0;
    for (int row = image.height - 37; row < image.height; ++row)
      for (int column = 0; column < image.width; ++column) {
        swatch += image.at(column, row) == not_a_number_color;
        if (column > image.width - 3) CHECK(image.at(column, row) == white);
      }
    CHECK(swatch >= 100);
  }

  TEST_CASE("a legend with too many entries states how many more there are") {
    Look with = look(320, 180, unit_view);
    with.range.reset(), with.colormap = nullptr;
    const auto drawn = [&](std::size_t count, const std::string& name) {
      with.categories.assign(count, name);
      return picture(particle(0, 0, 0.1, 0), with);
    };
    const Image image = drawn(20, "a");
    CHECK_FALSE(image == drawn(25, "a"));
    const auto left_of_legend = [](const Image& of) {
      int column = of.width / 2;
      while (of.at(column, 30) == white) ++column;
      return column;
    };
    CHECK(left_of_legend(image) == left_of_legend(drawn(2, "and 13 more")));
  }

  TEST_CASE("an unlisted category keeps its colour in the plot and has no entry in the legend") {
    Look with = look(640, 360, unit_view);
    with.range.reset(), with.colormap = nullptr;
    with.categories = {"ring", "plate", "ball"}, with.unlisted = {1};
    Particles two = particle(-0.5, 0, 0.3, 1);
    two.add(0, 0, 0.3, 2);
    const Image image = picture(two, with);
    const auto pixels = [&](std::size_t category, int from, int to) {
      int count = 0;
      for (int row = 0; row < image.height; ++row)
        for (int column = from; column < to; ++column)
          count += image.at(column, row) == category_color(category);
      return count;
    };
    const int middle = 430;  // column between plot and legend
    CHECK(pixels(1, 0, middle) > 500);
    CHECK(pixels(1, middle, image.width) == 0);
    CHECK(pixels(2, 0, middle) > 500);
    CHECK(pixels(2, middle, image.width) > 20);
  }

  TEST_CASE("a method's name follows even a title too long for the picture") {
    const std::string title(200, 'T');
    for (const auto& [width, height] : {std::pair(320, 180), {1280, 720}}) {
      Particles none;
      FrameView with = none.frame(), without = none.frame();
      with.title = without.title = title;
      without.method = "";
      const Look of_both = look(width, height, unit_view);
      FrameView other = with;
      other.method = "enoh";
      Renderer renderer(of_both);
      const Image method = renderer.draw(with);
      CHECK_FALSE(method == Image(renderer.draw(without)));
      CHECK_FALSE(method == Image(renderer.draw(other)));
    }
  }
}
