#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "render/gl/solid_painter.hpp"
#include "render/renderer.hpp"
#include "render/smooth_light.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/synthetic.hpp"

namespace of_sheets {

using namespace taut;
using namespace taut::render;
using namespace taut::test;

namespace {

/// n × n squares of two triangles over [−0.8, 0.8]², deformed by `map`.
struct Sheet {
  std::vector<double> x, value, diameter;
  std::vector<std::uint32_t> triangle;

  template <class Map>
  Sheet(int n, const Map& map) {
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const double X = -0.8 + 1.6 * i / n, Y = -0.8 + 1.6 * j / n;
        const std::array<double, 2> at = map(X, Y);
        x.insert(x.end(), at.begin(), at.end());
        value.push_back(0.5 + X / 1.6), diameter.push_back(0);
      }
    const auto point = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        triangle.insert(triangle.end(), {point(i, j), point(i + 1, j), point(i, j + 1), point(i, j + 1),
                                         point(i + 1, j), point(i + 1, j + 1)});
  }
  FrameView frame() const {
    FrameView frame;
    frame.x = x, frame.value = value, frame.diameter = diameter, frame.triangle = triangle;
    return frame;
  }
};

std::array<double, 2> same(double X, double Y) { return {X, Y}; }

Look bare(int side = 200) {
  Look with = look(side, side, unit_view);
  with.bare = true;
  return with;
}

Image drawn(const FrameView& frame, const Look& with) {
  Renderer renderer(with);
  return renderer.draw(frame);
}

std::uint8_t opacity(const Image& image, int column, int row) {
  return image.pixels[image.offset(column, row) + 3];
}

int difference(Rgb a, Rgb b) {
  int most = 0;
  for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

}  // namespace

TEST_SUITE("image") {
  TEST_CASE("a stretched surface and a bent surface have no gap") {
    // both maps keep |X|, |Y| ≤ 0.7 inside the picture
    const auto stretched = [](double X, double Y) { return std::array{1.2 * X, 0.7 * Y}; };
    const auto bent = [](double X, double Y) { return std::array{X, 0.8 * Y + 0.2 * X * X}; };
    const auto gaps = [](const auto& map) {
      Look with = bare();
      with.transparent = true;
      const Image image = drawn(Sheet(9, map).frame(), with);
      int transparent = 0;
      for (int k = 0; k < 100 * 100; ++k) {
        const auto [x, y] = map(-0.7 + 1.4 * (k % 100) / 99.0, -0.7 + 1.4 * (k / 100) / 99.0);
        const int column = static_cast<int>(100 * (1 + x)), row = static_cast<int>(100 * (1 - y));
        transparent += opacity(image, column, row) != 255;
      }
      CHECK(opacity(image, 1, 1) == 0);
      return transparent;
    };
    CHECK(gaps(stretched) == 0);
    CHECK(gaps(bent) == 0);
  }

  TEST_CASE("a surface interpolates values, not colours") {
    const Image image = drawn(Sheet(1, same).frame(), bare());
    const auto table = find_colormap("viridis")->table();
    int worst = 0;
    for (int column = 25; column < 175; ++column) {
      const double value = 0.5 + (2 * (column + 0.5) / 200 - 1) / 1.6;
      for (const int row : {30, 100, 170})
        worst = std::max(worst, difference(image.at(column, row),
                                           table[static_cast<std::size_t>(std::lround(255 * value))]));
    }
    CHECK(worst <= 6);  // two colour steps
    Rgb mean{};
    for (std::size_t k = 0; k < 3; ++k)
      mean[k] = static_cast<std::uint8_t>((table[0][k] + table[255][k]) / 2);
    CHECK(difference(mean, image.at(100, 100)) > 40);
  }

  TEST_CASE("a point with the value NaN gives its triangles the colour of NaN") {
    Sheet sheet(2, same);
    sheet.value[4] = std::numeric_limits<double>::quiet_NaN();
    const Image image = drawn(sheet.frame(), bare());
    CHECK(image.at(98, 98) == not_a_number_color);
    CHECK(image.at(24, 175) != not_a_number_color);  // a triangle of other points
  }

  TEST_CASE("categories are not interpolated") {
    Look with = bare();
    with.categories = {"a", "b", "c"};
    Sheet sheet(4, same);
    for (double& value : sheet.value) value = value < 0.5 ? 0 : 2;
    const Image image = drawn(sheet.frame(), with);
    int between = 0;
    for (int column = 0; column < 200; ++column)
      between += difference(image.at(column, 90), category_color(1)) < 20;
    CHECK(between == 0);
  }

  TEST_CASE("a loose particle of a surface is drawn, a point of the surface is not") {
    Sheet sheet(1, same);
    sheet.triangle.clear();
    sheet.triangle = {0, 0, 0};
    sheet.diameter[3] = 0.2;
    const Image image = drawn(sheet.frame(), bare());
    CHECK(image.at(178, 22) != white);
    CHECK(image.at(21, 22) == white);
  }

  TEST_CASE("without a background, pixels are opaque only where something is drawn") {
    for (const bool surface : {false, true}) {
      CAPTURE(surface);
      Look with = look(400, 300, unit_view);
      with.transparent = true;
      Sheet sheet(4, same);
      if (!surface) sheet.triangle.clear();
      std::ranges::fill(sheet.diameter, surface ? 0 : 0.41);
      FrameView frame = sheet.frame();
      frame.title = "Title", frame.unit = "Pa";
      const Image image = drawn(frame, with);
      const PageLayout layout = make_layout(400, 300, unit_view);
      const auto at = [&](double x, double y) {
        return opacity(image, layout.plot.x + static_cast<int>(layout.column(x)),
                       layout.plot.y + static_cast<int>(layout.row(y)));
      };
      CHECK(opacity(image, 0, 0) == 0);
      CHECK(at(-0.97, 0.97) == 0);
      CHECK(at(0, 0) == 255);
      int faint = 0, dark = 0;  // of the title
      for (int k = 0; k < 150 * 25; ++k) {
        const std::uint8_t alpha = opacity(image, k % 150, k / 150);
        faint += alpha > 0 && alpha<128, dark += alpha> 200;
      }
      CHECK(faint > 0);
      CHECK(dark > 10);
      // premultiplied: at most the opacity
      int wrong = 0;
      for (std::size_t k = 0; k < image.pixels.size(); ++k)
        wrong += image.pixels[k] > image.pixels[k / 4 * 4 + 3];
      CHECK(wrong == 0);
    }
  }

  TEST_CASE("the light of a surface varies smoothly on round faces and changes at edges") {
    // y points downwards
    const std::vector<Vector> points{{0, 0, 0}, {0, -1, 0}, {1, 0, 0.1}, {1, -1, 0.2}, {1, 0, -1}};
    const std::vector<std::uint32_t> triangles{0, 2, 1, 1, 2, 3, 2, 4, 3};
    const std::vector<float> light = smooth_light(points, triangles);
    REQUIRE(light.size() == 9);
    CHECK(light[1] == light[4]);  // at a slight angle
    CHECK(light[4] != light[6]);  // beyond the edge
    const auto alone = [&](float x, float z) {
      return light_on(x / std::hypot(x, z), 0, z / std::hypot(x, z));
    };
    CHECK(light[0] == Approx(alone(-0.1f, 1)));
    CHECK(light[7] == Approx(alone(1, 0)));
  }
}

}  // namespace of_sheets
