#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/scene/shapes/combined.hpp"
#include "engine/scene/shapes/implicit.hpp"
#include "engine/simulation.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

double volume(const InitialParticles& layout) {
  return std::accumulate(layout.V0.begin(), layout.V0.end(), 0.0);
}

long clamped(const InitialParticles& layout) {
  return std::count(layout.clamped.begin(), layout.clamped.end(), 1);
}

Scene one_body(int dim, double spacing, const std::vector<Shape>& shapes) {
  Scene scene;
  scene.dim = dim;
  scene.spacing = spacing;
  scene.materials = {ring_rubber()};
  scene.bodies.resize(1);
  scene.bodies[0].name = "thing";
  scene.bodies[0].shapes = shapes;
  return scene;
}

Body body_of(const Shape& shape) {
  Body body;
  body.shapes = {shape};
  return body;
}

template <class Make>
SceneError scene_error(const Make& make) {
  try {
    make();
  } catch (const SceneError& error) {
    return error;
  }
  FAIL("no SceneError");
  return {"", ""};
}

bool contains(const SceneError& error, const std::string& text) {
  return std::string(error.what()).find(text) != std::string::npos;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("layout: two rings have 4398 particles and exactly the area of two rings") {
    const InitialParticles rings = make_initial_particles(colliding_rings());
    CHECK(rings.size() == 4398);
    CHECK(rings.first == std::vector<int>{0, 2199, 4398});
    CHECK(volume(rings) == relative(2 * std::numbers::pi * (0.04 * 0.04 - 0.03 * 0.03), 1e-13));
    CHECK(clamped(rings) == 0);
  }

  TEST_CASE(
      "layout: layers of a ring begin half a spacing inside its faces, with particles at least 0.99 dp apart") {
    const InitialParticles rings = make_initial_particles(colliding_rings());
    double least = 1, innermost = 1, outermost = 0;
    for (int i = 0; i < rings.first[1]; ++i) {
      const double r = std::hypot(rings.x[i][0] + 0.045, rings.x[i][1]);
      innermost = std::min(innermost, r);
      outermost = std::max(outermost, r);
      for (int j = 0; j < i; ++j)
        least = std::min(least, std::hypot(rings.x[i][0] - rings.x[j][0], rings.x[i][1] - rings.x[j][1]));
    }
    CHECK(innermost == relative(0.0305));
    CHECK(outermost == relative(0.0395));
    CHECK(least > 0.99 * 0.001);
  }

  TEST_CASE("layout: a mirrored ring is the mirror image of the other ring, particle by particle") {
    const Scene scene = colliding_rings();
    const InitialParticles rings = make_initial_particles(scene);
    const int n = rings.first[1];
    const double rounding = 2 * std::numeric_limits<double>::epsilon() * 0.1;
    double asymmetry = 0;
    int different = 0;
    for (int k = 0; k < n; ++k) {
      asymmetry = std::max(asymmetry, std::abs(rings.x[k][0] + rings.x[n + k][0]));
      different += rings.x[k][1] != rings.x[n + k][1] || rings.V0[k] != rings.V0[n + k];
      different += rings.v[k][0] != -rings.v[n + k][0];
    }
    CHECK(asymmetry <= rounding);
    CHECK(different == 0);
    CHECK(rings.v[0][0] == relative(0.06 * scene.materials[0].sound_speed()));
  }

  TEST_CASE("layout: a ring is its own mirror image in y to the last bit") {
    const InitialParticles ring = make_initial_particles(one_body(2, 0.001, {Ring{{0, 0, 0}, 0.004, 0.008}}));
    int alone = 0;
    for (const Point& x : ring.x) {
      if (std::abs(x[1]) < 1e-12) continue;
      alone += std::none_of(ring.x.begin(), ring.x.end(),
                            [&](const Point& y) { return y[0] == x[0] && y[1] == -x[1]; });
    }
    CHECK(ring.size() > 100);
    CHECK(alone == 0);
  }

  TEST_CASE("layout: the plate has 1612 particles, 612 of them in its clamp") {
    const InitialParticles plate = make_initial_particles(oscillating_plate(0.05));
    CHECK(plate.size() == 1612);
    CHECK(clamped(plate) == 612);
    CHECK(volume(plate) == relative(0.2 * 0.02 + 0.068 * 0.036));
    for (int i = 0; i < plate.size(); ++i) {
      CHECK(static_cast<bool>(plate.clamped[i]) == (plate.x[i][0] < 0));
      if (plate.clamped[i]) CHECK(plate.v[i] == Point{});
    }
    const auto tip = std::max_element(plate.x.begin(), plate.x.end());
    CHECK((*tip)[0] == relative(0.199));
    CHECK(plate.v[tip - plate.x.begin()][1] == relative(0.05 * 57.035, 0.01));
  }

  TEST_CASE("layout: ball and plate have 2928 particles, 4 columns of 8 clamped at each end") {
    const InitialParticles layout = make_initial_particles(ball_plate());
    CHECK(layout.size() == 2928);
    CHECK(layout.first[1] == (200 + 2 * 4) * 8);
    CHECK(clamped(layout) == 2 * 4 * 8);
    for (int i = 0; i < layout.size(); ++i) CHECK(layout.body[i] == (i >= layout.first[1]));
  }

  TEST_CASE("layout: a union counts overlapping regions once") {
    const Shape left = Box{{0, 0, 0}, {3, 2, 0}}, right = Box{{1, 0, 0}, {5, 2, 0}};
    CHECK(make_initial_particles(one_body(2, 1, {left, right})).size() == 5 * 2);
    CHECK(make_initial_particles(one_body(2, 1, {right, left})).size() == 5 * 2);
  }

  TEST_CASE(
      "layout: the particles of boxes, balls and hollow balls in 3D have the volume of the shape within 1 %") {
    CHECK(make_initial_particles(one_body(3, 0.5, {Box{{0, 0, 0}, {1, 2, 3}}})).size() == 2 * 4 * 6);
    const double ball = 4.0 / 3 * std::numbers::pi;
    CHECK(volume(make_initial_particles(one_body(3, 0.05, {Disc{{0, 0, 0}, 1}}))) == relative(ball, 0.01));
    CHECK(volume(make_initial_particles(one_body(3, 0.05, {Ring{{0, 0, 0}, 0.5, 1}}))) ==
          relative(ball * (1 - 0.125), 0.01));
  }

  TEST_CASE("layout: the spacing fits whole particles across the thinnest extent") {
    CHECK(fitted_spacing(body_of(Box{{0, 0, 0}, {0.2, 0.02, 0}}), 2, 0.003) == relative(0.02 / 7));
    CHECK(fitted_spacing(body_of(Box{{0, 0, 0}, {0.2, 0.02, 0.01}}), 3, 0.003) == relative(0.01 / 3));
    CHECK(fitted_spacing(body_of(Disc{{0, 0, 0}, 0.05}), 2, 0.03) == relative(0.1 / 3));
    CHECK(fitted_spacing(body_of(Ring{{0, 0, 0}, 0.03, 0.04}), 2, 0.001) ==
          0.001);  // round-off: 0.04 − 0.03 ≠ 0.01
    CHECK(fitted_spacing(body_of(Box{{0, 0, 0}, {1, 1, 0}}), 2, 40) == 1);
  }

  TEST_CASE("layout: bodies whose particles start less than half a spacing apart are refused") {
    Scene scene = one_body(2, 1, {Box{{0, 0, 0}, {3, 2, 0}}});
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].name = "other";
    scene.bodies[1].shapes = {Box{{2.6, 0, 0}, {5.6, 2, 0}}};
    CHECK(make_initial_particles(scene).size() == 12);
    scene.bodies[1].shapes = {Box{{2.4, 0, 0}, {5.4, 2, 0}}};
    const SceneError error = scene_error([&] { make_initial_particles(scene); });
    CHECK(error.key == "body.other");
    CHECK(contains(error, "'thing'"));
    CHECK(contains(error, "overlap"));
    CHECK(contains(error, "0.4"));
  }

  TEST_CASE("layout: the distance between particles of two bodies in 3D includes the depth") {
    Scene scene = one_body(3, 1, {Box{{0, 0, 0}, {2, 2, 2}}});
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].shapes = {Box{{0, 0, 1.8}, {2, 2, 3.8}}};
    CHECK(make_initial_particles(scene).size() == 16);
    scene.bodies[1].shapes = {Box{{0, 0, 1.4}, {2, 2, 3.4}}};
    CHECK_THROWS_AS(make_initial_particles(scene), SceneError);
  }

  TEST_CASE("layout: a body without particles is an error that names the body") {
    const SceneError error = scene_error([] {
      make_initial_particles(one_body(2, 1, {Disc{{0, 0, 0}, 0.2}}));
    });
    CHECK(error.key == "body.thing");
    CHECK(contains(error, "no particle: its shapes are smaller than the spacing"));
    Scene empty = one_body(2, 1, {Box{}});
    empty.bodies.clear();
    CHECK(scene_error([&] { make_initial_particles(empty); }).key == "body");
    CHECK(scene_error([&] { make_simulation(empty, {}); }).key == "body");
  }

  TEST_CASE("layout: a body without particles may have an empty shape, which the error mentions") {
    const Box box{{-4, -4, 0}, {4, 4, 0}};
    const Shape nothing = Implicit{box, constant(0)};
    const Shape apart = Combined{Combination::common, {Disc{{0, 0, 0}, 2}, Disc{{9, 0, 0}, 2}}};
    for (const Shape& shape : {nothing, apart}) {
      const SceneError error = scene_error([&] { make_initial_particles(one_body(2, 1, {shape})); });
      CHECK(error.key == "body.thing");
      CHECK(contains(error, "no particle: its shapes are empty or thinner than the spacing"));
    }
  }

  TEST_CASE("layout: more than 20 million particles are refused before they are made") {
    const SceneError error = scene_error([] { make_initial_particles(colliding_rings(0.06, 1e-5 / 2)); });
    CHECK(error.key == "spacing");
    CHECK(contains(error, "20 million"));
    CHECK(scene_error([] { make_initial_particles(colliding_rings(0.06, 1e-300)); }).key == "spacing");
  }

  TEST_CASE("layout: particles of shapes without exact measure are counted, not estimated") {
    const Box box{{0, 0, 0}, {300, 300, 0}};
    const Combined copies{Combination::together, std::vector<Shape>(300, box)};
    REQUIRE(copies.measure(2) > greatest_particle_number);
    Scene scene = one_body(2, 1, {copies});
    CHECK(make_initial_particles(scene).size() == 90000);
    scene.bodies[0].shapes = std::vector<Shape>(300, box);
    CHECK(make_initial_particles(scene).size() == 90000);
    scene.bodies.push_back(body_of(Box{{0, 400, 0}, {19950, 1400, 0}}));
    const SceneError error = scene_error([&] { make_initial_particles(scene); });
    CHECK(error.key == "spacing");
    CHECK(contains(error, "would make more than 20 million particles; at most 20 million are allowed"));
  }
}

}  // namespace of_this_file
