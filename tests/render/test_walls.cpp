#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "render/renderer.hpp"
#include "render/wall_grid.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/synthetic.hpp"

using namespace taut;
using namespace taut::render;
using namespace taut::test;

namespace {

struct Scene {
  std::vector<double> x, diameter{0.2}, value{0.5};
  std::vector<WallFace> walls;

  Scene(int dim, const WallFace& wall) : x(static_cast<std::size_t>(dim), 0.0), walls{wall} {}
  FrameView frame() const {
    FrameView view;
    view.dim = static_cast<int>(x.size());
    view.x = x, view.diameter = diameter, view.value = value, view.walls = walls;
    return view;
  }
};

Look bare(int dim, Rgb background = white) {
  Look with = look(200, 200, unit_view);
  with.bare = true, with.background = background;
  if (dim == 3) with.camera = Camera{.from = {0, -1, 0}};
  return with;
}

Image drawn(const Scene& scene, const Look& with) { return Renderer(with).draw(scene.frame()); }

int painted(const Image& image, const Rect& within, Rgb background = white) {
  int count = 0;
  for (int row = within.y; row < within.y + within.height; ++row)
    for (int column = within.x; column < within.x + within.width; ++column)
      count += image.at(column, row) != background;
  return count;
}

const Rect whole{0, 0, 200, 200};

}  // namespace

TEST_SUITE("image") {
  TEST_CASE("a wall in 2D is a line along its face, with strokes only behind it") {
    struct Case {
      WallFace wall;
      Rect behind, before;  // 100 pixels per metre
    };
    for (const Rgb background : {white, Rgb{0, 0, 0}}) {
      for (const auto& [wall, behind, before] :
           {Case{{{0.3, -0.5, 0}, {0, 1, 0}}, {0, 152, 200, 48}, {0, 120, 200, 28}},
            Case{{{-9, 0.5, 0}, {0, -1, 0}}, {0, 0, 200, 48}, {0, 52, 200, 28}},
            Case{{{0.5, 0, 0}, {-1, 0, 0}}, {152, 0, 48, 200}, {120, 0, 28, 200}}}) {
        const Image image = drawn(Scene(2, wall), bare(2, background));
        CHECK(painted(image, behind, background) > 100);
        CHECK(painted(image, before, background) == 0);
        const bool upright = std::abs(wall.normal[0]) > 0.5;
        for (int k = 0; k < 200; ++k) {
          int on_line = 0;
          for (int beside = -1; beside <= 1; ++beside) {
            const int there = (behind.width < 200 ? 150 : wall.normal[1] > 0 ? 150 : 50) + beside;
            on_line += upright ? image.at(there, k) != background : image.at(k, there) != background;
          }
          CHECK(on_line > 0);
        }
      }
    }
  }

  TEST_CASE("the strokes of a wall in 2D move with the wall") {
    Scene here(2, {{0, -0.5, 0}, {0, 1, 0}}), there = here;
    there.walls[0].at[0] = 0.1;
    there.x[0] = 0.1;
    const Image a = drawn(here, bare(2)), b = drawn(there, bare(2));
    int greatest = 0;
    for (int row = 0; row < 200; ++row)
      for (int column = 10; column < 200; ++column)
        greatest = std::max(greatest, std::abs(a.at(column - 10, row)[0] - b.at(column, row)[0]));
    CHECK(greatest <= 2);
    CHECK_FALSE(a == b);
  }

  TEST_CASE("a wall outside the view or at a non-finite place leaves no trace") {
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      Scene scene(dim, {{0, 0, 0}, {0, 0, 1}});
      scene.walls.clear();
      Renderer renderer(bare(dim));
      const Image without = renderer.draw(scene.frame());
      for (const double at : {-5.0, -1e300, std::nan(""), HUGE_VAL}) {
        CAPTURE(at);
        WallFace wall{{0, 0, 0}, {0, 0, 0}};
        wall.at[dim == 2 ? 1 : 2] = at, wall.normal[dim == 2 ? 1 : 2] = 1;
        scene.walls = {wall};
        CHECK(renderer.draw(scene.frame()) == without);
        wall.at[0] = at, wall.normal = {0.6, dim == 2 ? 0.8 : 0, dim == 2 ? 0 : 0.8};
        scene.walls = {wall};
        CHECK(renderer.draw(scene.frame()) == without);
      }
    }
  }

  TEST_CASE("a wall is drawn independently of the previous frame and stays in the plot") {
    Scene first(2, {{0, -0.5, 0}, {0.6, 0.8, 0}}), second = first;
    second.walls[0].at[1] = -0.3;
    const Look with = look(640, 360, unit_view);
    Renderer renderer(with);
    renderer.draw(first.frame());
    CHECK(renderer.draw(second.frame()) == drawn(second, with));
    const PageLayout layout = make_layout(640, 360, unit_view);
    Scene empty = second;
    empty.walls.clear();
    const Image walled = drawn(second, with), none = drawn(empty, with);
    int inside = 0, outside = 0;
    for (int row = 0; row < 360; ++row)
      for (int column = 0; column < 640; ++column) {
        if (walled.at(column, row) == none.at(column, row)) continue;
        const Rect& plot = layout.plot;
        const bool within =
            column >= plot.x && column < plot.x + plot.width && row >= plot.y && row < plot.y + plot.height;
        ++(within ? inside : outside);
      }
    CHECK(inside > 300);
    CHECK(outside == 0);
  }

  TEST_CASE(
      "a wall in 3D is a grid on its face that hides objects behind it and is hidden by objects before it") {
    const auto wall_at = [](double y) { return WallFace{{0, y, 0}, {0, -1, 0}}; };
    for (const Rgb background : {white, Rgb{0, 0, 0}}) {
      Scene behind(3, wall_at(0.5)), before(3, wall_at(-0.5)), none(3, wall_at(0));
      none.walls.clear();
      const Image far = drawn(behind, bare(3, background)), near = drawn(before, bare(3, background)),
                  without = drawn(none, bare(3, background));
      const Rect ball{92, 92, 16, 16};
      CHECK(painted(far, whole, background) > painted(without, whole, background) + 200);
      int hidden = 0, seen = 0;
      for (int row = ball.y; row < ball.y + ball.height; ++row)
        for (int column = ball.x; column < ball.x + ball.width; ++column) {
          hidden += far.at(column, row) != without.at(column, row);
          seen += near.at(column, row) != without.at(column, row);
        }
      CHECK(hidden == 0);
      CHECK(seen >= 16);
    }
  }

  TEST_CASE("a wall seen from its edge is a line, and a wall in perspective is drawn") {
    const Image edge = drawn(Scene(3, {{0, 0, -0.5}, {0, 0, 1}}), bare(3));
    CHECK(painted(edge, {0, 140, 200, 20}) > 20);
    CHECK(painted(edge, {0, 160, 200, 40}) == 0);
    Look close = bare(3);
    close.camera = Camera{.from = {0.3, -1, 0.2}, .field_of_view = 100};
    CHECK(painted(drawn(Scene(3, {{0, 0, 0}, {0, 0, 1}}), close), whole) > 100);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("the grid on a wall lies on its face, in whole cells from the wall's place") {
    for (const Vector& normal : {Vector{0, 0, 1}, Vector{0, -1, 0}, Vector{0.6, 0, -0.8}, Vector{1, 0, 0}}) {
      const WallFace wall{{0.1, 0.2, 0.3}, normal};
      const std::vector<Vector> points{{1, 2, 3}, {1.4, 2.2, 3.3}};
      const auto lines = grid_on(wall, points, 0.25);
      CHECK(lines.size() >= 10);
      CHECK(lines.size() < 40);
      for (const auto& [from, to] : lines)
        for (const Vector& end : {from, to}) {
          const Vector d{end[0] - wall.at[0], end[1] - wall.at[1], end[2] - wall.at[2]};
          CHECK(dot(d, normal) == Approx(0).scale(1).epsilon(1e-12));
          const double cells = dot(d, d) / (0.25 * 0.25);
          CHECK(cells == Approx(std::round(cells)).epsilon(1e-9));
        }
    }
  }

  TEST_CASE("a lost point does not make an endless grid") {
    const WallFace wall{{0, 0, 0}, {0, 0, 1}};
    std::vector<Vector> points(100, Vector{1, 1, 1});
    const std::size_t without_lost = grid_on(wall, points, 0.1).size();
    points.push_back({1e8, 0, 1});
    const auto lines = grid_on(wall, points, 0.1);
    CHECK(lines.size() <= 204);
    CHECK(lines.size() > without_lost);
    const auto is_under = [](const auto& line) { return line.first[0] < 1 && line.second[0] > 1; };
    CHECK(std::ranges::any_of(lines, is_under));
    CHECK(grid_on(wall, {}, 0.1).empty());
  }
}
