
#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/scene/shapes/turned.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.1, share = 0.3;

Scene brick(int dim) {
  Scene scene;
  scene.dim = dim;
  scene.spacing = dp;
  scene.materials = {ring_rubber(), ring_rubber()};
  scene.bodies.resize(1);
  scene.bodies[0].name = "brick";
  scene.bodies[0].shapes = {Box{{0, 0, 0}, {1, 1, 1}}};
  return scene;
}

struct Moves {  // in dp
  double least = 0, greatest = 0, mean_size = 0;
};
Moves moves_along(std::size_t axis, const InitialParticles& from, const InitialParticles& to) {
  Moves moves;
  for (std::size_t i = 0; i < from.x.size(); ++i) {
    const double by = (to.x[i][axis] - from.x[i][axis]) / dp;
    moves.least = std::min(moves.least, by);
    moves.greatest = std::max(moves.greatest, by);
    moves.mean_size += std::abs(by) / from.size();
  }
  return moves;
}

std::vector<Point> places(const Scene& scene) { return make_initial_particles(scene).x; }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("jitter: moves are reproducible and uniformly distributed up to a share of the spacing") {
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      Scene scene = brick(dim);
      const InitialParticles lattice = make_initial_particles(scene);
      scene.jitter = {share, 3};
      const InitialParticles moved = make_initial_particles(scene);
      for (std::size_t k = 0; k < 3; ++k) {
        CAPTURE(k);
        const Moves moves = moves_along(k, lattice, moved);
        const bool still = k >= static_cast<std::size_t>(dim);
        CHECK(moves.greatest <= (still ? 0 : share));
        CHECK(moves.least >= (still ? 0 : -share));
        if (still) continue;
        CHECK(moves.greatest > 0.9 * share);
        CHECK(moves.least < -0.9 * share);
        CHECK(moves.mean_size == relative(0.5 * share, 0.15));
      }
      CHECK(moved.V0 == lattice.V0);
      CHECK(moved.middle == lattice.x);
      CHECK(places(scene) == moved.x);
      scene.jitter.seed = 4;
      CHECK(places(scene) != moved.x);
      scene.jitter = {0.1 * share, 3};
      const InitialParticles less = make_initial_particles(scene);
      CHECK(less.x[5][1] - lattice.x[5][1] == relative(0.1 * (moved.x[5][1] - lattice.x[5][1]), 1e-9));
    }
  }

  TEST_CASE(
      "jitter: clamped and driven particles stay, as do guided ones in a rotated body, and other free components move") {
    Scene scene = brick(2);
    Body& body = scene.bodies[0];
    body.clamped = [](const Point& x) { return x[0] < dp ? 1.0 : 0.0; };
    body.guided[1] = [](const Point& x) { return x[0] > 1 - dp ? 1.0 : 0.0; };
    body.drives.resize(1);
    body.drives[0].where = [](const Point& x) { return x[0] > dp && x[0] < 2 * dp ? 1.0 : 0.0; };
    const InitialParticles lattice = make_initial_particles(scene);
    scene.jitter = {0.49, 1};
    const InitialParticles moved = make_initial_particles(scene);
    CHECK(moved.clamped == lattice.clamped);  // regions are tested at the middles of cells
    CHECK(moved.drive == lattice.drive);
    CHECK(moved.guided == lattice.guided);
    for (int i = 0; i < lattice.size(); ++i) {
      const double row = lattice.x[i][0];
      CHECK((moved.x[i][0] == lattice.x[i][0]) == (row < 2 * dp));
      CHECK((moved.x[i][1] == lattice.x[i][1]) == (row < 2 * dp || row > 1 - dp));
    }
    body.rotation = Rotation{.about = {0.5, 0.5, 0}, .angle = 90};
    const InitialParticles turned = make_initial_particles(scene);
    int guided = 0;
    for (int i = 0; i < turned.size(); ++i) {
      if (turned.guided[i] == 0) continue;
      CHECK(turned.x[i] == turned.middle[i]);
      ++guided;
    }
    CHECK(guided > 5);
  }

  TEST_CASE("jitter: regions select cells of the layout, and velocities are evaluated at moved positions") {
    Scene scene = brick(2);
    Body& body = scene.bodies[0];
    body.parts = {{1, [](const Point& x) { return x[1] > 0.5 ? 1.0 : 0.0; }}};
    body.velocity[0] = [](const Point& x) { return x[1]; };
    const InitialParticles lattice = make_initial_particles(scene);
    scene.jitter = {0.49, 1};
    const InitialParticles moved = make_initial_particles(scene);
    CHECK(moved.material == lattice.material);
    for (int i = 0; i < moved.size(); ++i) CHECK(moved.v[i][0] == moved.x[i][1]);
  }

  TEST_CASE("jitter: a load acts on the same particles as without jitter") {
    Scene scene = brick(2);
    Load load;
    load.kind = Load::Kind::force_density;
    load.where = [](const Point& x) { return x[0] > 1 - 0.6 * dp ? 1.0 : 0.0; };
    load.value[0] = constant(1000);
    scene.bodies[0].loads = {load};
    for (const double by : {0.0, 0.45}) {
      CAPTURE(by);
      scene.jitter = {by, 1};
      const auto simulation = make_simulation(scene, with_method("oenog"));
      make_steps(*simulation, 10);
      const double momentum = balance(simulation->snapshot(), scene).linear_momentum[0];
      CHECK(momentum / simulation->time() == relative(1000 * 10 * dp * dp, 1e-9));
    }
  }

  TEST_CASE("jitter: particles on a face stay on it, also if the body is rotated") {
    for (const double angle : {0.0, 30.0}) {
      Scene scene = brick(3);
      scene.bodies[0].on_boundary = true;
      if (angle != 0) scene.bodies[0].rotation = Rotation{.angle = angle};
      const InitialParticles lattice = make_initial_particles(scene);
      scene.jitter = {share, 1};
      const InitialParticles moved = make_initial_particles(scene);
      CHECK(moved.V0 == lattice.V0);
      int on_faces = 0, free = 0;
      for (int i = 0; i < moved.size(); ++i) {
        const Point was = unplaced_point(scene.bodies[0], lattice.x[i], 3),
                    is = unplaced_point(scene.bodies[0], moved.x[i], 3);
        for (int k = 0; k < 3; ++k) {
          const bool on_face = std::abs(was[k] - 0.5) > 0.5 - 1e-9;
          (on_face ? on_faces : free) += 1;
          CHECK((std::abs(is[k] - was[k]) < 1e-12) == on_face);
        }
      }
      CHECK(on_faces == 3 * 2 * 11 * 11);
      CHECK(free == 3 * 9 * 11 * 11);
    }
  }

  TEST_CASE("jitter: a rotated shape and a rotated body have the same particles") {
    Scene scene = brick(2);
    scene.jitter = {share, 1};
    scene.bodies[0].rotation = Rotation{.about = {0.5, 0.5, 0}, .angle = 40};
    const std::vector<Point> of_body = places(scene);
    scene.bodies[0].rotation.reset();
    scene.bodies[0].shapes = {
        Turned{scene.bodies[0].shapes[0], Rotation{.about = {0.5, 0.5, 0}, .angle = 40}}};
    const std::vector<Point> of_shape = places(scene);
    REQUIRE(of_shape.size() == of_body.size());
    for (std::size_t i = 0; i < of_body.size(); ++i)
      CHECK(distance_between(of_body[i], of_shape[i], 2) < 1e-9);
  }

  TEST_CASE("jitter: mirrored rings are mirror images to the last bit, and no other symmetry remains") {
    Scene scene = colliding_rings(0.06, 0.001);
    for (Body& body : scene.bodies) {
      const Ring& ring = *body.shapes[0].as<Ring>();
      body.shapes = {Ring{ring.centre, ring.inner, ring.outer, RoundLayout::aligned}};
    }
    const InitialParticles layers = make_initial_particles(scene);
    scene.jitter = {share, 1};
    const InitialParticles moved = make_initial_particles(scene);
    const int n = moved.first[1];
    REQUIRE(2 * n == moved.size());
    for (int i = 0; i < n; ++i) {
      CHECK(moved.x[i][0] == -moved.x[n + i][0]);
      CHECK(moved.x[i][1] == moved.x[n + i][1]);
      CHECK(moved.turned[i] == i);
    }
    CHECK(layers.turned[0] != 0);
    CHECK(moved.x[0] != layers.x[0]);
  }
}

}  // namespace of_this_file
