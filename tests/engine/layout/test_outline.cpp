#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "engine/layout/outline.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.001;

Scene of(std::vector<Shape> shapes) {
  Scene scene;
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  Body body;
  body.name = "body";
  body.shapes = std::move(shapes);
  scene.bodies = {body};
  return scene;
}

bool is_in_body(const Scene& scene, const Point& x, double tolerance) {
  return std::ranges::any_of(scene.bodies[0].shapes,
                             [&](const Shape& shape) { return shape->holds(x, 2, tolerance); });
}

void check_faces(const Scene& scene, double length) {
  const InitialParticles initial = make_initial_particles(scene);
  const Outline outline = make_outline(scene, initial);
  double sum = 0;
  for (const Outline::Segment& segment : outline.segments) {
    const Point &a = outline.x[segment.node[0]], &b = outline.x[segment.node[1]];
    sum += segment.length;
    CHECK(segment.length == Approx(std::hypot(b[0] - a[0], b[1] - a[1])));
    CHECK(segment.length == Approx(dp).epsilon(0.3));
    const double off = 0.1 * dp * segment.sense / segment.length;
    const Point middle{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0};
    CHECK_FALSE(is_in_body(scene, {middle[0] + off * (b[1] - a[1]), middle[1] - off * (b[0] - a[0]), 0}, 0));
    CHECK(is_in_body(scene, {middle[0] - off * (b[1] - a[1]), middle[1] + off * (b[0] - a[0]), 0}, 0));
  }
  CHECK(sum == Approx(length).epsilon(1e-3));
  for (int n = 0; n < outline.size(); ++n) {
    CHECK(is_in_body(scene, outline.x[n], 1e-6 * dp));
    CHECK(outline.beside[n][0] != Outline::none);
    CHECK(outline.beside[n][1] != Outline::none);
    CHECK(outline.segments[outline.beside[n][0]].node[1] == n);
    CHECK(outline.segments[outline.beside[n][1]].node[0] == n);
    double one = 0, x = 0, y = 0, square = 0;
    for (int k = outline.begin[n]; k < outline.begin[n + 1]; ++k) {
      const auto& [particle, weight] = outline.shares[k];
      one += weight, square += weight * weight;
      x += weight * initial.x[particle][0], y += weight * initial.x[particle][1];
    }
    CHECK(one == Approx(1).epsilon(1e-12));
    CHECK(std::hypot(x - outline.x[n][0], y - outline.x[n][1]) < 1e-12);
    CHECK(square < 3);
  }
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("outline: a node at a slot is a mean of particles on its own side") {
    const Scene scene = of({Box{{0, 0, 0}, {6 * dp, 6 * dp, 0}}, Box{{7 * dp, 0, 0}, {13 * dp, 6 * dp, 0}}});
    const InitialParticles initial = make_initial_particles(scene);
    const Outline outline = make_outline(scene, initial);
    REQUIRE(outline.size() > 40);
    for (int n = 0; n < outline.size(); ++n)
      for (int k = outline.begin[n]; k < outline.begin[n + 1]; ++k)
        CHECK((initial.x[outline.shares[k].particle][0] < 6.5 * dp) == (outline.x[n][0] < 6.5 * dp));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("outline: a box, a disc and a ring have closed faces in every layout") {
    check_faces(of({Box{{0, 0, 0}, {0.02, 0.007, 0}}}), 0.054);
    for (const RoundLayout layout : {RoundLayout::spaced, RoundLayout::lattice}) {
      check_faces(of({Disc{{0.003, 0.001, 0}, 0.01, layout}}), 2 * std::numbers::pi * 0.01);
      check_faces(of({Ring{{0.003, 0.001, 0}, 0.01, 0.016, layout}}), 2 * std::numbers::pi * 0.026);
    }
    check_faces(of({Ring{{0.003, 0.001, 0}, 0.01, 0.016, RoundLayout::aligned}}),
                2 * std::numbers::pi * 0.026);
  }

  TEST_CASE("outline: a union has no face where one shape covers another") {
    check_faces(of({Box{{0, 0, 0}, {0.02, 0.006, 0}}, Box{{0.006, -0.01, 0}, {0.014, 0, 0}}}), 0.072);
    check_faces(of({Box{{0, 0, 0}, {0.02, 0.006, 0}}, Box{{0.012, 0, 0}, {0.03, 0.006, 0}}}), 0.072);
  }

  TEST_CASE("outline: each node of a ring is half a spacing from a particle") {
    const Scene scene = of({Ring{{0, 0, 0}, 0.03, 0.04}});
    const InitialParticles initial = make_initial_particles(scene);
    const Outline outline = make_outline(scene, initial);
    std::vector<int> nodes(initial.x.size());
    for (int n = 0; n < outline.size(); ++n) {
      const auto distance = [&](const Point& x) {
        return std::hypot(x[0] - outline.x[n][0], x[1] - outline.x[n][1]);
      };
      const auto nearest = std::ranges::min_element(initial.x, {}, distance);
      CHECK(distance(*nearest) == Approx(0.5 * dp).epsilon(1e-6));
      ++nodes[nearest - initial.x.begin()];
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double r = std::hypot(initial.x[i][0], initial.x[i][1]);
      CHECK(nodes[i] == (r < 0.03 + dp || r > 0.04 - dp ? 1 : 0));
    }
  }

  TEST_CASE("outline: a mirrored body has the mirror image, in the same order, to the last bit") {
    const Scene scene = colliding_rings(0.06, 0.002);
    const Outline outline = make_outline(scene, make_initial_particles(scene));
    const int half = outline.size() / 2, shares = outline.begin[half];
    REQUIRE(outline.size() == 2 * half);
    REQUIRE(outline.body[half - 1] == 0);
    for (int n = 0; n < half; ++n) {
      CHECK(outline.x[n][0] == -outline.x[n + half][0]);
      CHECK(outline.x[n][1] == outline.x[n + half][1]);
    }
    for (int k = 0; k < shares; ++k) CHECK(outline.shares[k].weight == outline.shares[k + shares].weight);
    const std::size_t segments = outline.segments.size() / 2;
    for (std::size_t k = 0; k < segments; ++k) {
      const Outline::Segment &a = outline.segments[k], &b = outline.segments[k + segments];
      CHECK(a.node[0] + half == b.node[0]);
      CHECK(a.node[1] + half == b.node[1]);
      CHECK(a.length == b.length);
      CHECK(a.sense == -b.sense);
    }
  }
}

}  // namespace of_this_file
