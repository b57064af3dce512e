#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "cli/drawing/staging.hpp"
#include "engine/error.hpp"
#include "tests/support/relative.hpp"

using namespace taut;
using namespace taut::test;
using namespace taut::cli;

namespace {

using Numbers = std::vector<double>;

Origins two_pairs() {
  return {.dim = 2,
          .x0 = {0, 0, 1, 0, 0, 3, 1, 3},
          .m = {1, 1, 1, 3},
          .diameter = Numbers(4, 1),
          .body = {0, 0, 1, 1}};
}

const Numbers moved{0, 1, 1, 1, 4, 3, 8, 5};

FrameView frame(const Numbers& x, const Origins& origins, const Numbers& value) {
  FrameView view;
  view.dim = origins.dim;
  view.x = x, view.diameter = origins.diameter, view.value = value;
  return view;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a default drawing shows every particle at its position") {
    const Origins origins = two_pairs();
    const StagedParticles staged = Staging({}, origins)(frame(moved, origins, {1, 2, 3, 4}));
    CHECK(staged.x == moved);
    CHECK(staged.value == Numbers{1, 2, 3, 4});
    CHECK(staged.diameter == origins.diameter);
    CHECK(staged.cell.empty());
  }

  TEST_CASE("a cut hides particles by their initial positions") {
    Drawing drawing;
    drawing.is_cut = [](const Point& x) { return static_cast<double>(x[1] > 2); };
    const Origins origins = two_pairs();
    Numbers swapped = moved;
    swapped[1] = 9;
    const StagedParticles staged = Staging(drawing, origins)(frame(swapped, origins, {1, 2, 3, 4}));
    CHECK(staged.x == Numbers{0, 9, 1, 1});
    CHECK(staged.value == Numbers{1, 2});
  }

  TEST_CASE("a cut that hides all particles is refused") {
    Drawing drawing;
    drawing.cut = "1";
    drawing.is_cut = [](const Point&) { return 1.0; };
    CHECK_THROWS_WITH_AS(Staging(drawing, two_pairs()), doctest::Contains("cut = \"1\" hides all particles"),
                         UsageError);
  }

  TEST_CASE("a followed body has its centre of mass in the origin, and the view is centred there") {
    Drawing drawing;
    drawing.followed = 1;
    const Origins origins = two_pairs();
    const Staging staging(drawing, origins);
    const StagedParticles staged = staging(frame(moved, origins, {1, 2, 3, 4}));
    CHECK(staged.x == Numbers{-7, -3.5, -6, -3.5, -3, -1.5, 1, 0.5});  // centre of mass: (7, 4.5)
    SequenceBounds bounds;
    staging.extend(bounds, staged);
    const render::View view = *fitted(drawing, bounds).look.view;
    CHECK(view.x_max == Approx(1.5 * 3.5));  // 3 m plus half a diameter
    CHECK(view.x_min == Approx(-1.5 * 3.5));
    CHECK(view.y_max == Approx(1.5 * 2));
    CHECK(bounds.range({}) == render::Range{1, 4});
    drawing.cut = "y > 2";
    drawing.is_cut = [](const Point& x) { return static_cast<double>(x[1] > 2); };
    CHECK(Staging(drawing, origins)(frame(moved, origins, {1, 2, 3, 4})).x == Numbers{-7, -3.5, -6, -3.5});
  }

  TEST_CASE("the automatic view contains the undeformed outline of the particles that determine it") {
    const Origins origins = two_pairs();
    const auto view = [&](Drawing drawing) {
      const Staging staging(drawing, origins);
      SequenceBounds bounds;
      staging.extend(bounds, staging(frame(moved, origins, {1, 2, 3, 4})));
      return *fitted(drawing, bounds).look.view;
    };
    for (const Outlines outline :
         {Outlines::none, Outlines::deformed, Outlines::undeformed, Outlines::both}) {
      CAPTURE(static_cast<int>(outline));
      const bool undeformed = outline == Outlines::undeformed || outline == Outlines::both;
      const render::View all = view({.outline = outline});
      CHECK(all.y_min == Approx((undeformed ? -0.5 : 0.5) - 0.05 * 9));
      CHECK(all.y_max == Approx(5.5 + 0.05 * 9));
      CHECK(view({.outline = outline, .hidden = {0}}).x_min ==
            Approx(undeformed ? -0.5 - 0.05 * 9 : 3.5 - 0.05 * 5));
      CHECK(view({.outline = outline, .followed = 1}).x_max == Approx(1.5 * (undeformed ? 7.5 : 3.5)));
    }
  }

  TEST_CASE("if the followed body is hidden or cut, the automatic view contains the shown particles") {
    const Origins origins = two_pairs();
    Drawing drawing;
    drawing.followed = 1;
    drawing.cut = "y > 2";
    for (const bool cut : {false, true}) {
      if (cut)
        drawing.is_cut = [](const Point& x) { return static_cast<double>(x[1] > 2); };
      else
        drawing.hidden = {1};
      const Staging staging(drawing, origins);
      SequenceBounds bounds;
      staging.extend(bounds, staging(frame(moved, origins, {1, 2, 3, 4})));
      const render::View view = *fitted(drawing, bounds).look.view;
      CHECK(view.x_max == Approx(1.5 * 7.5));
      CHECK(view.y_min == Approx(-1.5 * 4));
      drawing.hidden.clear();
    }
  }

  TEST_CASE("in style cells, particles are drawn as deformed cells, with their values") {
    Drawing drawing;
    drawing.style = Style::cells;
    Origins origins = two_pairs();
    const Staging staging(drawing, origins);
    const StagedParticles drawn = staging.completed(staging(frame(moved, origins, {1, 2, 3, 4})));
    CHECK(drawn.x == moved);
    CHECK(drawn.value == Numbers{1, 2, 3, 4});
    REQUIRE(drawn.cell.size() == 16);
    CHECK(drawn.cell[8] == Approx(4));
    CHECK(drawn.cell[9] == Approx(2));
  }

  TEST_CASE("beside a cut, cells end half-way to the removed neighbour, also on the boundary of a body") {
    Origins origins{.dim = 2, .x0 = {}, .m = Numbers(9, 1), .diameter = {}, .body = std::vector<int>(9, 0)};
    for (int n = 0; n < 9; ++n) {
      origins.x0.insert(origins.x0.end(), {n % 3 * 1.0, n / 3 * 1.0});
      origins.diameter.push_back(std::sqrt((n % 3 == 1 ? 1 : 0.5) * (n / 3 == 1 ? 1 : 0.5)));
    }
    Drawing drawing;
    drawing.style = Style::cells;
    drawing.is_cut = [](const Point& x) { return static_cast<double>(x[0] > 1.5); };
    const Staging staging(drawing, origins);
    const StagedParticles drawn = staging.completed(staging(frame(origins.x0, origins, Numbers(9, 0))));
    REQUIRE(drawn.value.size() == 6);
    double area = 0, right = 0;
    for (std::size_t k = 0; k < 6; ++k) {
      const double* edge = &drawn.cell[4 * k];
      area += std::abs(edge[0] * edge[3] - edge[1] * edge[2]);
      right = std::max(right, drawn.x[2 * k] + 0.5 * (std::abs(edge[0]) + std::abs(edge[2])));
    }
    CHECK(area == Approx(3));
    CHECK(right == Approx(1.5));
  }

  TEST_CASE("walls keep their place, or move past a followed body") {
    const Origins origins = two_pairs();
    for (const Style style : {Style::discs, Style::cells}) {
      Drawing drawing;
      drawing.style = style;
      drawing.walls = {{{1, -2, 0}, {0, 1, 0}}};
      const auto wall = [&] {
        const Staging staging(drawing, origins);
        const StagedParticles drawn = staging.completed(staging(frame(moved, origins, {1, 2, 3, 4})));
        REQUIRE(drawn.view().walls.size() == 1);
        CHECK(drawn.walls[0].normal == Point{0, 1, 0});
        return drawn.walls[0].at;
      };
      CHECK(wall() == Point{1, -2, 0});
      drawing.followed = 1;
      CHECK(wall() == Point{-6, -6.5, 0});
    }
  }

  TEST_CASE("particles of another scene are refused") {
    const Origins origins = two_pairs();
    Origins more = origins;
    more.m.push_back(1);
    CHECK_THROWS_AS(Staging({}, more)(frame(moved, origins, {1, 2, 3, 4})), UsageError);
  }
}
