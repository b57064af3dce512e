#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "render/image/image_difference.hpp"
#include "render/image/png.hpp"
#include "render/renderer.hpp"
#include "tests/support/files.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/synthetic.hpp"

using namespace taut;
using namespace taut::render;
using namespace taut::test;

namespace {

Particles one_disc(double x, double y, double diameter, double value) {
  Particles particles;
  particles.add(x, y, diameter, value);
  return particles;
}

Image drawn(const Particles& particles, const Look& with) {
  Renderer renderer(with);
  return renderer.draw(particles.frame());
}

/// Bounding box of non-white pixels.
Rect extent(const Image& image) {
  int left = image.width, right = -1, top = image.height, bottom = -1;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      if (image.at(column, row) == white) continue;
      left = std::min(left, column), right = std::max(right, column);
      top = std::min(top, row), bottom = std::max(bottom, row);
    }
  }
  return {left, top, right - left + 1, bottom - top + 1};
}

}  // namespace

TEST_SUITE("image") {
  TEST_CASE("an empty frame in a picture too small for texts is white") {
    Renderer renderer(look(160, 100, unit_view));
    CHECK_FALSE(renderer.draw(one_disc(0, 0, 1, 0).frame()) == Image(160, 100));
    CHECK(renderer.draw(Particles().frame()) == Image(160, 100));
  }

  TEST_CASE("an arrow marks an end of the bar if a value lies beyond it by more than half a colour step") {
    const Look with = look(640, 360, unit_view);
    const PageLayout layout = make_layout(640, 360, unit_view);
    const int middle = layout.key.x + static_cast<int>(0.5 * 1.15 * layout.font);
    const int above = layout.key.y - 4, below = layout.key.y + layout.key.height + 3;
    struct Case {
      double value;
      Rgb top, bottom;
    };
    const Rgb high = {253, 231, 37}, low = {68, 1, 84};
    for (const auto& [value, top, bottom] : {Case{0.5, white, white},
                                             {1.5, high, white},
                                             {-0.1, white, low},
                                             {1.001, white, white},
                                             {-0.001, white, white},
                                             {std::numeric_limits<double>::infinity(), high, white},
                                             {std::numeric_limits<double>::quiet_NaN(), white, white}}) {
      const auto& value_now = value;
      CAPTURE(value_now);
      const Image image = drawn(one_disc(0, 0, 0.1, value), with);
      CHECK(image.at(middle, above) == top);
      CHECK(image.at(middle, below) == bottom);
    }
  }

  TEST_CASE(
      "categories have a colour each in the plot and in the legend, and a long legend fits the picture") {
    Look with = look(640, 360, unit_view);
    with.range.reset(), with.colormap = nullptr;
    with.categories = {"ring", "a plate with a very long name", "ball"};
    Particles three;
    for (int k = 0; k < 3; ++k) three.add(-0.5 + 0.5 * k, 0, 0.3, k);
    const Image image = drawn(three, with);
    for (std::size_t k = 0; k < 3; ++k) {
      CAPTURE(k);
      int in_plot = 0, in_legend = 0;
      for (int row = 0; row < 360; ++row)
        for (int column = 0; column < 640; ++column)
          if (image.at(column, row) == category_color(k)) ++(column < 430 ? in_plot : in_legend);
      CHECK(in_plot > 500);
      CHECK(in_legend > 20);
    }
    with.categories.assign(100, "one of many");
    CHECK(extent(drawn(three, with)).height < 360);
  }

  TEST_CASE("on a dark background texts are light, and no white remains") {
    for (const bool solid : {false, true}) {
      CAPTURE(solid);
      Look with = look(640, 360, unit_view);
      with.background = {10, 20, 30};
      FrameView frame;
      const std::vector<double> x{0, 0, 0}, diameter{0.4}, value{2};
      frame.x = std::span(x).first(solid ? 3 : 2), frame.diameter = diameter, frame.value = value;
      frame.dim = solid ? 3 : 2;
      frame.title = "A title";
      if (solid) with.camera.emplace();
      Renderer renderer(with);
      Image image = renderer.draw(frame);
      CHECK(image == renderer.draw(frame));
      const PageLayout layout = make_layout(640, 360, unit_view);
      CHECK(image.at(0, 0) == with.background);
      CHECK(image.at(layout.plot.x + 2, layout.plot.y + 2) == with.background);
      int light = 0, lighter = 0;
      for (int row = 0; row < 360; ++row)
        for (int column = 0; column < 640; ++column) {
          const Rgb color = image.at(column, row);
          light += color[0] > 200 && color[2] > 200;
          lighter += color[0] > 240 && color[2] > 240;
        }
      CHECK(light > 100);
      CHECK(lighter == 0);
    }
  }

  TEST_CASE("texts and bar leave their place blank if left out, and a font without room is refused") {
    Particles particles;
    particles.add(0.2, 0.4, 0.6, 0.5);
    FrameView frame = particles.frame();
    frame.title = "A title", frame.method = "tl", frame.field = "speed", frame.unit = "m/s";
    const Look with = look(640, 360, unit_view);
    const PageLayout layout = make_layout(640, 360, unit_view);
    const Image all = Renderer(with).draw(frame);
    const auto is_blank = [](const Image& image, const Rect& place) {
      for (int row = place.y; row < place.y + place.height; ++row)
        for (int column = place.x; column < place.x + place.width; ++column)
          if (image.at(column, row) != white) return false;
      return true;
    };
    const int above = layout.plot.y - 8;  // the bar's uppermost number rises above the bar
    const Rect title{layout.plot.x, 0, 200, above}, time{440, 0, 200, above},
        foot{0, layout.plot.y + layout.plot.height, 300, 360 - layout.plot.y - layout.plot.height};
    for (const auto& [place, parts] : {std::pair{title, TextParts{.title = false, .method = false}},
                                       {time, TextParts{.time = false}},
                                       {foot, TextParts{.scale = false}},
                                       {layout.key, TextParts{.bar = false}}}) {
      Look less = with;
      less.texts.parts = parts;
      CHECK_FALSE(is_blank(all, place));
      Renderer renderer(less);
      Image image = renderer.draw(frame);
      CHECK(is_blank(image, place));
      CHECK(image == renderer.draw(frame));  // the second frame repaints only some texts
    }
    Look large = with;
    large.texts.font = 200;
    CHECK_THROWS_WITH_AS(Renderer{large}, doctest::Contains("leave no room in a picture of 640x360"),
                         UsageError);
  }

  TEST_CASE("the glyph size scales discs and balls, and is refused out of bounds") {
    for (const bool solid : {false, true}) {
      CAPTURE(solid);
      Look with = look(400, 400, unit_view);
      with.bare = true;
      FrameView frame;
      const std::vector<double> x{0, 0, 0}, diameter{0.5}, value{0};
      frame.x = std::span(x).first(solid ? 3 : 2), frame.diameter = diameter, frame.value = value;
      frame.dim = solid ? 3 : 2;
      if (solid) with.camera.emplace();
      const auto width = [&](double glyph) {
        with.glyph = glyph;
        return extent(Renderer(with).draw(frame)).width;
      };
      CHECK(std::abs(width(1) - 100) <= 2);
      CHECK(std::abs(width(0.5) - 50) <= 2);
      CHECK(std::abs(width(1.5) - 150) <= 2);
      for (const double wrong : {0.0, -1.0, 21.0, std::nan("")}) {
        with.glyph = wrong;
        CHECK_THROWS_WITH_AS(Renderer{with}, doctest::Contains("from 0.05 to 20"), UsageError);
      }
    }
  }

  TEST_CASE("an empty frame in 3D is white") {
    // OpenGL silently does nothing if libGL precedes OSMesa in the link line.
    Look with = look(160, 100, unit_view);
    with.camera.emplace();
    FrameView frame;
    frame.dim = 3;
    Renderer renderer(with);
    Image& image = const_cast<Image&>(renderer.draw(frame));
    // new images are white
    std::fill(image.pixels.begin(), image.pixels.end(), 7);
    renderer.draw(frame);
    CHECK(image == Image(160, 100));
  }

  TEST_CASE(
      "a renderer draws each frame as if it were the only one, after changes of texts, particles or cells") {
    const Particles rings = two_rings(), disc = one_disc(0.03, 0.01, 0.02, 1),
                    beyond = one_disc(0, 0, 0.02, 2);
    const std::vector<double> cell = {0.02, 0.01, -0.01, 0.02};
    std::vector<FrameView> frames(9, rings.frame());
    frames[1].time = 0.012345, frames[1].title = "A title that is longer by a little, gyq";
    frames[2] = disc.frame(), frames[2].time = 0;
    frames[3] = disc.frame(), frames[3].field = "pressure", frames[3].unit = "J";
    frames[4] = disc.frame(), frames[4].method = "";
    frames[5] = disc.frame(), frames[5].cell = cell;
    frames[7] = beyond.frame();
    const Look with = look(640, 360, rings_view);
    Renderer renderer(with, 0.02);
    for (const FrameView& frame : frames) CHECK(renderer.draw(frame) == Renderer(with, 0.02).draw(frame));
  }

  TEST_CASE("a disc has the colour of its value and the background is white") {
    for (const auto& [width, height] : {std::pair{160, 100}, {640, 360}}) {
      const Image image = drawn(one_disc(0.2, 0.3, 0.5, 0.25), look(width, height, unit_view));
      const Rgb color = find_colormap("viridis")->table()[64];
      CHECK(color_at(image, unit_view, 0.2, 0.3) == color);
      CHECK(color_at(image, unit_view, 0.2, 0.5) == color);
      CHECK(color_at(image, unit_view, 0.2, 0.6) == white);
      CHECK(color_at(image, unit_view, 0.2, -0.3) == white);  // y is up
      CHECK(color_at(image, unit_view, -0.2, 0.3) == white);
    }
  }

  TEST_CASE("a disc is round, has its size and is smooth at its rim") {
    const Image image = drawn(one_disc(0.1, 0, 1.0, 0), look(200, 100, unit_view));
    const Rect rect = extent(image);
    CHECK(rect.width == 50);
    CHECK(rect.height == 50);
    double area = 0;
    for (int row = 0; row < 100; ++row) {
      // the first colour of viridis has blue 84
      for (int column = 0; column < 200; ++column) area += (255 - image.at(column, row)[2]) / (255.0 - 84);
    }
    CHECK(area == Approx(M_PI * 25 * 25).epsilon(0.005));
  }

  TEST_CASE("a disc with a radius of two pixels or more has its size, and a smaller disc is drawn larger") {
    // drawn radius: r from 2 pixels on, √2 r + ¼ up to 1 pixel; in between both formulas are blended
    for (const auto& [radius, drawn_as] :
         {std::pair{0.8, 1.38137}, {1.0, 1.66421}, {1.5, 1.93566}, {2.0, 2.0}, {3.0, 3.0}, {6.0, 6.0}}) {
      const auto& radius_now = radius;
      CAPTURE(radius_now);
      const Image image = drawn(one_disc(0.003, 0.001, 2 * radius / 50, 0), look(100, 100, unit_view));
      double area = 0;
      for (int row = 0; row < 100; ++row)
        for (int column = 0; column < 100; ++column) area += (255 - image.at(column, row)[2]) / (255.0 - 84);
      CHECK(std::sqrt(area / M_PI) == Approx(drawn_as).scale(0).epsilon(0.03));
    }
  }

  TEST_CASE("axes have equal scales and the whole view is visible in square, wide and high pictures") {
    const View wide = {0, 10, 0, 1};
    for (const auto& [width, height] : {std::pair{100, 100}, {200, 70}, {70, 200}}) {
      Particles ends;
      for (const double x : {0.5, 9.5}) ends.add(x, 0.5, 1, 0.5);
      const Image image = drawn(ends, look(width, height, wide));
      const Rect rect = extent(image);
      CHECK(rect.width == Approx(10.0 * rect.height).epsilon(0.15));
      CHECK(rect.width >= width - 1);
    }
  }

  TEST_CASE("values beyond the range have the colours of the ends") {
    Particles particles;
    const double infinite = std::numeric_limits<double>::infinity();
    const double values[] = {-5, -infinite, 9, infinite};
    for (int i = 0; i < 4; ++i) particles.add(-0.75 + 0.5 * i, 0, 0.4, values[i]);
    const Image image = drawn(particles, look(200, 200, unit_view));
    CHECK(color_at(image, unit_view, -0.75, 0) == Rgb{68, 1, 84});
    CHECK(color_at(image, unit_view, -0.25, 0) == Rgb{68, 1, 84});
    CHECK(color_at(image, unit_view, 0.25, 0) == Rgb{253, 231, 37});
    CHECK(color_at(image, unit_view, 0.75, 0) == Rgb{253, 231, 37});
  }

  TEST_CASE("NaN has a colour of its own") {
    const Image image = drawn(one_disc(0, 0, 0.4, NAN), look(100, 100, unit_view));
    CHECK(color_at(image, unit_view, 0, 0) == Rgb{255, 0, 255});
  }

  TEST_CASE("particles without a finite position or a positive size are left out") {
    Particles particles;
    particles.add(NAN, 0, 0.4, 0.5);
    particles.add(0, INFINITY, 0.4, 0.5);
    particles.add(0, 0, NAN, 0.5);
    particles.add(0, 0, INFINITY, 0.5);
    particles.add(0, 0, 0, 0.5);
    particles.add(0, 0, -1, 0.5);
    particles.add(1e300, 0, 0.4, 0.5);
    CHECK(drawn(particles, look(100, 100, unit_view)) == Image(100, 100));
  }

  TEST_CASE("a line with a non-finite or far-away end is left out") {
    const Look with = look(100, 100, unit_view);
    for (const double wrong : {std::nan(""), HUGE_VAL, 1e300})
      for (std::size_t k = 0; k < 4; ++k) {
        CAPTURE(k);
        std::vector<double> line{-0.5, -0.5, 0.5, 0.5};
        FrameView frame;
        frame.outline = line;
        CHECK_FALSE(Renderer(with).draw(frame) == Image(100, 100));
        line[k] = wrong;
        CHECK(Renderer(with).draw(frame) == Image(100, 100));
      }
  }

  TEST_CASE("a particle outside the view is drawn if its rim reaches into the picture") {
    const Image image = drawn(one_disc(-1.15, 0, 0.4, 0), look(100, 100, unit_view));
    CHECK(image.at(0, 50) == Rgb{68, 1, 84});
    CHECK(image.at(4, 50) == white);
  }

  TEST_CASE("a pixel of two overlapping discs shows the disc with the nearer centre, whatever their order") {
    Particles forth, back;
    forth.add(-0.2, 0, 0.8, 0), forth.add(0.2, 0, 0.8, 1);
    back.add(0.2, 0, 0.8, 1), back.add(-0.2, 0, 0.8, 0);
    const Look with = look(100, 100, unit_view);
    const Image image = drawn(forth, with);
    CHECK(color_at(image, unit_view, -0.05, 0) == Rgb{68, 1, 84});
    CHECK(color_at(image, unit_view, 0.05, 0) == Rgb{253, 231, 37});
    const ImageDifference difference = compare(image, drawn(back, with));
    CHECK(difference.share < 0.002);
  }

  TEST_CASE("neighbours too small for gaps look solid") {
    Particles particles;
    for (int i = -20; i <= 20; ++i) {
      for (int j = -20; j <= 20; ++j) particles.add(0.037 * i, 0.037 * j, 0.037, 0);
    }
    const Image image = drawn(particles, look(100, 100, unit_view));
    for (int row = 30; row < 70; ++row) {
      for (int column = 30; column < 70; ++column) CHECK(image.at(column, row) == Rgb{68, 1, 84});
    }
  }

  TEST_CASE("the same frame gives the same bytes, from one renderer or from two") {
    const Particles particles = two_rings();
    const Particles other = one_disc(0, 0, 0.02, 1);
    const Look with = look(640, 360, rings_view);
    Renderer first(with);
    Renderer second(with);
    first.draw(other.frame());
    const Image once = first.draw(particles.frame());
    first.draw(other.frame());
    CHECK(second.draw(particles.frame()) == once);
    CHECK(first.draw(particles.frame()) == once);
    CHECK_FALSE(first.draw(other.frame()) == once);
    const TemporaryFolder folder;
    write_png(once, folder / "a.png");
    write_png(second.draw(particles.frame()), folder / "b.png");
    CHECK(text_of(folder / "a.png") == text_of(folder / "b.png"));
  }

  TEST_CASE("a disc in a large picture has its place and size to two pixels") {
    const Image image = drawn(one_disc(0, 0, 1.9, 0.5), look(5000, 2400, unit_view));
    const PageLayout layout = make_layout(5000, 2400, unit_view);
    const Rgb color = find_colormap("viridis")->table()[128];
    for (int y = -9; y <= 9; ++y) CHECK(color_at(image, unit_view, 0, 0.1 * y) == color);
    const double edge = std::sqrt(0.95 * 0.95 - 0.6 * 0.6);
    for (const double y : {-0.6, 0.6}) {
      const double two_pixels = 2 / layout.pixels_per_metre;
      CHECK(color_at(image, unit_view, edge - two_pixels, y) == color);
      CHECK(color_at(image, unit_view, edge + two_pixels, y) == white);
    }
  }

  TEST_CASE("the colour bar goes from low at the bottom to high at the top, and every text is visible") {
    Particles particles = one_disc(0, 0, 0.1, 0);
    const Look with = look(640, 360, unit_view);
    Renderer renderer(with);
    const Image image = renderer.draw(particles.frame());
    const PageLayout layout = make_layout(640, 360, unit_view);
    const int column = layout.key.x + 4;
    CHECK(image.at(column, layout.key.y) == Rgb{253, 231, 37});
    CHECK(image.at(column, layout.key.y + layout.key.height - 1) == Rgb{68, 1, 84});
    FrameView frame = particles.frame();
    const auto changes = [&](auto&& change) {
      frame = particles.frame();
      change();
      return !(renderer.draw(frame) == image);
    };
    CHECK_FALSE(changes([] {}));
    CHECK(changes([&] { frame.title = "Two rods"; }));
    CHECK(changes([&] { frame.method = "og"; }));
    CHECK(changes([&] { frame.time = 0.006; }));
    CHECK(changes([&] { frame.field = "pressure"; }));
    CHECK(changes([&] { frame.unit = "m"; }));
  }

  TEST_CASE("long and empty texts do not cover the particles or the time") {
    const std::string longest(500, 'W');
    std::string letters;
    for (int i = 0; i < 100; ++i) letters += "ß→";
    for (const std::string& text : {longest, letters, std::string()}) {
      Particles particles = one_disc(0, 0, 1.9, 0.5);
      FrameView frame = particles.frame();
      frame.title = frame.method = frame.field = frame.unit = text;
      Renderer renderer(look(320, 180, unit_view));
      const Image image = renderer.draw(frame);
      const Image plain = drawn(particles, look(320, 180, unit_view));
      const Rect plot = make_layout(320, 180, unit_view).plot;
      int changed = 0;
      for (int row = plot.y; row < plot.y + plot.height; ++row) {
        for (int column = plot.x; column < plot.x + plot.width; ++column) {
          changed += image.at(column, row) != plain.at(column, row);
        }
      }
      CHECK(changed == 0);
      const int right = static_cast<int>(make_layout(320, 180, unit_view).right);
      for (int row = 0; row < plot.y / 2; ++row) {
        for (int column = right - 40; column < 320; ++column) {
          changed += image.at(column, row) != plain.at(column, row);
        }
      }
      CHECK(changed == 0);
    }
  }

  TEST_CASE("pictures of the smallest size and of odd sizes are drawn") {
    for (const auto& [width, height] : {std::pair{64, 64}, {65, 333}, {333, 65}, {240, 120}, {1001, 121}}) {
      const Image image = drawn(one_disc(0, 0, 0.5, 0), look(width, height, unit_view));
      CHECK(color_at(image, unit_view, 0, 0) == Rgb{68, 1, 84});
      CHECK(image.at(width - 1, height - 1) == white);
    }
  }

  TEST_CASE("a value in a range without extent has the middle colour") {
    Look with = look(100, 100, unit_view);
    with.range = {3, 3};
    CHECK(color_at(drawn(one_disc(0, 0, 0.4, 3), with), unit_view, 0, 0) ==
          find_colormap("viridis")->table()[128]);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("options out of bounds and a missing colour map are refused") {
    const auto refused = [](auto&& change) {
      Look with = look(100, 100, unit_view);
      change(with);
      CHECK_THROWS_AS(Renderer{with}, UsageError);
    };
    refused([](Look& with) { with.size->width = 63; });
    refused([](Look& with) { with.size->height = 8193; });
    refused([](Look& with) { with.view->x_max = with.view->x_min; });
    refused([](Look& with) { with.view->y_max = NAN; });
    refused([](Look& with) { with.range->low = 2; });
    refused([](Look& with) { with.range->high = INFINITY; });
    refused([](Look& with) { with.colormap = nullptr; });
  }

  TEST_CASE("a look without a size, view or range throws a logic error") {
    const auto refused = [](auto&& change) {
      Look with = look(100, 100, unit_view);
      change(with);
      CHECK_THROWS_AS(Renderer{with}, std::logic_error);
    };
    refused([](Look& with) { with.size.reset(); });
    refused([](Look& with) { with.view.reset(); });
    refused([](Look& with) { with.range.reset(); });
  }

  TEST_CASE(
      "3D particles need a camera, 2D particles must not have one, and a camera must be within bounds") {
    Look with = look(64, 64, unit_view);
    FrameView frame;
    frame.dim = 3;
    CHECK_THROWS_WITH_AS(Renderer(with).draw(frame), doctest::Contains("needs a camera"), std::logic_error);
    with.camera.emplace();
    CHECK_NOTHROW(Renderer(with).draw(frame));
    frame.dim = 2;
    CHECK_THROWS_AS(Renderer(with).draw(frame), std::logic_error);
    const auto refused = [&](const Camera& camera) {
      with.camera = camera;
      CHECK_THROWS_AS(Renderer{with}, UsageError);
    };
    refused({.from = {0, 0, 0}});
    refused({.from = {1, 0, 0}, .up = {0, NAN, 0}});
    refused({.field_of_view = -1});
    refused({.field_of_view = 121});
  }

  TEST_CASE("arrays of unequal lengths throw a logic error") {
    Renderer renderer(look(64, 64, unit_view));
    Particles particles = one_disc(0, 0, 1, 1);
    particles.x.pop_back();
    CHECK_THROWS_AS(renderer.draw(particles.frame()), std::logic_error);
  }
}
