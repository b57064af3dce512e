#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "render/gl/gl_context.hpp"
#include "render/renderer.hpp"
#include "render/solids.hpp"
#include "tests/support/synthetic.hpp"

using namespace taut;
using namespace taut::render;
using namespace taut::test;

namespace {

struct Bodies {
  std::vector<double> x, diameter, value, cell;

  void add(const Vector& at, double d, double v) {
    x.insert(x.end(), at.begin(), at.end()), diameter.push_back(d), value.push_back(v);
  }
  void add_cell(const Vector& a, const Vector& b, const Vector& c) {
    for (const Vector& edge : {a, b, c}) cell.insert(cell.end(), edge.begin(), edge.end());
  }
  FrameView frame() const {
    FrameView frame;
    frame.dim = 3;
    frame.x = x, frame.diameter = diameter, frame.value = value, frame.cell = cell;
    return frame;
  }
};

const Camera along_y{.from = {0, -1, 0}};

Look bare(const Camera& camera, int width = 200, int height = 200) {
  Look with = look(width, height, unit_view);
  with.camera = camera;
  with.bare = true;
  return with;
}

Image drawn(const Bodies& bodies, const Look& with) {
  Renderer renderer(with);
  return renderer.draw(bodies.frame());
}

Bodies lattice(int n) {
  Bodies bodies;
  const double dp = 1.2 / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        bodies.add({(i + 0.5) * dp - 0.6, (j + 0.5) * dp - 0.6, (k + 0.5) * dp - 0.6}, dp,
                   0.5 + 0.4 * std::sin(i + 2.0 * j + 3.0 * k));
  return bodies;
}

/// Greatest channel deviation from `base` at the same brightness; 255 if lighter than `base`.
double hue_difference(Rgb color, Rgb base) {
  const double light = static_cast<double>(color[0] + color[1] + color[2]) / (base[0] + base[1] + base[2]);
  double difference = light > 1.01 ? 255 : 0;
  for (std::size_t k = 0; k < 3; ++k) difference = std::max(difference, std::abs(color[k] - light * base[k]));
  return difference;
}

}  // namespace

TEST_SUITE("image") {
  TEST_CASE("a sphere is a disc of its size from three camera positions, and keeps its hue") {
    const Rgb base = find_colormap("viridis")->table()[191];
    for (const Camera& camera : {along_y, Camera{}, Camera{.from = {0, 0, 5}}}) {
      Bodies one;
      one.add({0, 0, 0}, 1, 0.75);
      const Image image = drawn(one, bare(camera));
      int inside = 0, wrong = 0;
      for (int row = 0; row < 200; ++row) {
        for (int column = 0; column < 200; ++column) {
          const double r = std::hypot(column - 99.5, row - 99.5);  // radius 50 pixels
          if (r > 51) wrong += image.at(column, row) != white;
          if (r < 49) ++inside, wrong += hue_difference(image.at(column, row), base) > 2;
        }
      }
      CHECK(inside > 7000);
      CHECK(wrong == 0);
      const auto [left, right] = std::pair(image.at(80, 80), image.at(125, 125));
      CHECK(left[1] > right[1] + 20);
      CHECK(hue_difference(image.at(100, 100), base) <= 2);
      CHECK(image.at(100, 100)[1] > 0.9 * base[1]);  // towards the camera
    }
  }

  TEST_CASE(
      "the nearer of two spheres hides the other in any order, and intersecting spheres are both visible") {
    for (const bool swapped : {false, true}) {
      Bodies two;
      const auto add_near = [&] { two.add({0, -0.6, 0}, 0.8, 1); };
      if (!swapped) add_near();
      two.add({0.1, 0.6, 0}, 0.8, 0);
      if (swapped) add_near();
      const Rgb yellow = find_colormap("viridis")->at(1);
      const Image front = drawn(two, bare(along_y));
      CHECK(hue_difference(front.at(100, 100), yellow) <= 2);
      CHECK(hue_difference(front.at(144, 100), yellow) > 10);
      const Image behind = drawn(two, bare({.from = {0, 1, 0}}));
      CHECK(hue_difference(behind.at(100, 100), yellow) > 10);
    }
    Bodies pressed;
    pressed.add({-0.2, 0, 0}, 0.8, 0), pressed.add({0.2, 0, 0}, 0.8, 1);
    const Image image = drawn(pressed, bare(along_y));
    CHECK(hue_difference(image.at(97, 100), find_colormap("viridis")->at(0)) <= 2);
    CHECK(hue_difference(image.at(102, 100), find_colormap("viridis")->at(1)) <= 2);
  }

  TEST_CASE("hidden spheres are left out, and no channel of a pixel changes by more than 1") {
    Bodies all = lattice(20);
    for (std::size_t i = 0; i < all.diameter.size(); ++i)  // overlaps and gaps
      all.diameter[i] *= 1 + 0.5 * std::sin(7.0 * static_cast<double>(i));
    const View view = unit_view;
    const PageLayout layout = make_layout(400, 300, view, false);
    for (const Camera& camera : {Camera{}, along_y, Camera{.field_of_view = 50, .front = 0.8}}) {
      const Projection projection(camera, view);
      const std::vector<std::uint32_t> colors(all.value.size(), 0xff40a0d0u);
      Solids solids(layout);
      solids.place_balls(all.frame(), projection, colors);
      const std::vector<Ball> seen(solids.balls().begin(), solids.balls().end());
      std::vector<Ball> every;
      for (std::size_t i = 0; i < all.value.size(); i += 1000) {
        FrameView part = all.frame();
        part.x = part.x.subspan(3 * i, 3000), part.value = part.value.subspan(i, 1000);
        part.diameter = part.diameter.subspan(i, 1000);
        solids.place_balls(part, projection, colors);
        every.insert(every.end(), solids.balls().begin(), solids.balls().end());
      }
      REQUIRE(every.size() == all.value.size());
      CHECK(seen.size() < every.size() / 2);
      Image few(400, 300), many(400, 300);
      GlContext context(400, 300);
      const auto paint = [&](Image& image, const std::vector<Ball>& balls) {
        const GlContext::Current current(context, image);
        SolidPainter(400, 300, layout.plot).draw(current.framebuffer(), {.balls = balls});
      };
      paint(few, seen);
      paint(many, every);
      int greatest = 0;  // depth range and rounding differ
      for (std::size_t k = 0; k < few.pixels.size(); ++k)
        greatest = std::max(greatest, std::abs(few.pixels[k] - many.pixels[k]));
      CHECK(greatest <= 1);
    }
  }

  TEST_CASE("a sphere in the middle of a picture covers as many pixels left as right, and above as below") {
    Bodies one;
    one.add({0, 0, 0}, 1.3, 0.75);
    const Image image = drawn(one, bare(along_y));
    for (int row = 0; row < 200; ++row)
      for (int column = 0; column < 200; ++column) {
        const bool covered = image.at(column, row) != white;
        REQUIRE(covered == (image.at(199 - column, row) != white));
        REQUIRE(covered == (image.at(column, 199 - row) != white));
      }
  }

  TEST_CASE("a renderer draws later frames in 3D as a new renderer does, also smaller ones") {
    const Bodies many = lattice(8), few = lattice(5);
    Bodies cells;
    cells.add({0, 0, 0}, 0.5, 0.3), cells.add({0.4, 0, 0.2}, 0.3, 0.9);
    for (const double edge : {0.5, 0.3}) cells.add_cell({edge, 0, 0}, {0, edge, 0}, {0, 0, edge});
    const Look with = bare(Camera{});
    Renderer renderer(with);
    renderer.draw(many.frame());
    CHECK(renderer.draw(few.frame()) == drawn(few, with));
    CHECK(renderer.draw(cells.frame()) == drawn(cells, with));
    CHECK(renderer.draw(cells.frame()) == drawn(cells, with));
    CHECK(renderer.draw(many.frame()) == drawn(many, with));
  }

  TEST_CASE("a box of cells is a closed surface") {
    // outer layer of 12³ sheared cells
    Bodies box;
    const int n = 12;
    const double dp = 0.08;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) {
          const auto outer = [](int at) { return at == 0 || at == n - 1; };
          if (!outer(i) && !outer(j) && !outer(k)) continue;
          const double z = (k - 5.5) * dp;
          box.add({(i - 5.5) * dp + 0.25 * z, (j - 5.5) * dp, z}, dp, 0.5);
          box.add_cell({dp, 0, 0}, {0, dp, 0}, {0.25 * dp, 0, dp});
        }
    const Image image = drawn(box, bare(along_y));
    const Rgb base = find_colormap("viridis")->table()[128];
    int gaps = 0, beyond = 0;
    for (int row = 0; row < 200; ++row) {
      for (int column = 0; column < 200; ++column) {
        const double z = (99.5 - row) / 100, x = (column - 99.5) / 100 - 0.25 * z;
        const double out = std::max(std::abs(x), std::abs(z)) - 0.48;
        gaps += out < -0.02 && hue_difference(image.at(column, row), base) > 3;
        beyond += out > 0.02 && image.at(column, row) != white;
      }
    }
    CHECK(gaps == 0);
    CHECK(beyond == 0);
  }

  TEST_CASE("a cell in 2D is a parallelogram in the colour of its value") {
    Particles one;
    one.add(0, 0, 0.5, 0.25);
    FrameView frame = one.frame();
    const std::vector<double> cell{1.0, 0, 0.5, 0.6};
    frame.cell = cell;
    Renderer renderer(look(200, 200, unit_view));
    const Image& image = renderer.draw(frame);
    const Rgb color = find_colormap("viridis")->table()[64];
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {0.7, 0.27}, {-0.7, -0.27}, {0.2, -0.27}})
      CHECK(color_at(image, unit_view, x, y) == color);
    for (const auto& [x, y] : {std::pair(-0.7, 0.27), {0.7, -0.27}, {0.0, 0.33}})
      CHECK(color_at(image, unit_view, x, y) == white);
  }

  TEST_CASE("a hollow between bodies is darker than an open face") {
    Bodies bodies;
    for (int i = -10; i <= 10; ++i)
      for (int j = -10; j <= 10; ++j) {
        bodies.add({0.09 * i, 0.09 * j, 0}, 0.09, 0.5);
        bodies.add_cell({0.09, 0, 0}, {0, 0.09, 0}, {0, 0, 0.09});
      }
    const Camera above{.from = {0, 0, 1}};
    const Image open = drawn(bodies, bare(above));
    bodies.add({0, 0, 0.25}, 0.4, 0.5);
    bodies.add_cell({0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4});
    const Image covered = drawn(bodies, bare(above));
    CHECK(covered.at(124, 100)[1] < open.at(124, 100)[1] - 10);
    CHECK(covered.at(170, 100) == open.at(170, 100));
    const Rgb base = find_colormap("viridis")->table()[128];
    CHECK(hue_difference(covered.at(124, 100), base) <= 2);
  }

  TEST_CASE("a 3D picture drawn in bands is like one drawn at once") {
    const Bodies bodies = lattice(9);
    const Image small = drawn(bodies, bare({}, 2000, 1200)), large = drawn(bodies, bare({}, 4000, 2400));
    double greatest = 0;
    for (int row = 0; row < 1200; row += 7) {
      for (int column = 500; column < 1500; column += 7) {
        double mean = 0;
        for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}})
          mean += large.at(2 * column + x, 2 * row + y)[1] / 4.0;
        const Rgb here = small.at(column, row);
        bool rim = false;
        for (const auto& [x, y] : {std::pair(3, 0), {-3, 0}, {0, 3}, {0, -3}})
          rim = rim || std::abs(small.at(column + x, std::clamp(row + y, 0, 1199))[1] - here[1]) > 25;
        if (!rim) greatest = std::max(greatest, std::abs(mean - here[1]));
      }
    }
    CHECK(greatest < 25);
  }
}
