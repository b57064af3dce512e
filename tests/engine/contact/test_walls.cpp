#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/error.hpp"
#include "engine/terms/lennard_jones_contact.hpp"
#include "engine/terms/penalty_contact.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.001;

Wall wall(const char* name, const Point& at, const Point& normal) { return {name, at, normal}; }

Scene flying_block() {
  const double speed = 0.02 * ring_rubber().sound_speed();
  Scene scene;
  scene.name = "flying-block";
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  Body block;
  block.name = "block";
  block.shapes = {Box{{-8.2 * dp, -3 * dp, 0}, {-0.2 * dp, 3 * dp, 0}}};
  block.velocity[0] = constant(speed);
  scene.bodies = {block};
  return scene;
}

Scene two_blocks() {
  Scene scene = flying_block();
  Body image = scene.bodies[0];
  image.name = "image";
  image.shapes = {Box{{0.2 * dp, -3 * dp, 0}, {8.2 * dp, 3 * dp, 0}}};
  image.velocity[0] = constant(-image.velocity[0]({}));
  image.mirror[0] = true;
  scene.bodies.push_back(image);
  return scene;
}

Scene disc_in_corner() {
  const double c0 = ring_rubber().sound_speed();
  Scene scene;
  scene.name = "disc-in-corner";
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  Body disc;
  disc.name = "disc";
  disc.shapes = {Disc{{0.0045, 0.0042, 0}, 0.004}};
  disc.velocity[0] = constant(-0.03 * c0);
  disc.velocity[1] = constant(-0.06 * c0);
  scene.bodies = {disc};
  scene.walls = {wall("floor", {0, 0, 0}, {0, 1, 0}), wall("slope", {-0.0012, 0, 0}, {0.8, 0.6, 0})};
  return scene;
}

/// Relative, less the wall impulses.
struct MomentumChange {
  double linear, angular;
};
MomentumChange change(const Balance& before, const Balance& after) {
  const auto linear = [&](std::size_t k) {
    return after.linear_momentum[k] - after.of_walls.linear[k] - before.linear_momentum[k];
  };
  return {std::hypot(linear(0), linear(1)) / before.momentum_scale,
          std::abs(after.angular_momentum[2] - after.of_walls.angular[2] - before.angular_momentum[2]) /
              before.angular_scale};
}

}  // namespace

TEST_SUITE("term") {
  TEST_CASE("Lennard-Jones contact: the force is −∂E/∂r and vanishes beyond one spacing") {
    CHECK(lennard_jones_force(dp, dp, 1e7, 2) == 0);
    CHECK(lennard_jones_force(1.1 * dp, dp, 1e7, 2) == 0);
    CHECK(lennard_jones_energy(1.1 * dp, dp, 1e7, 2) == 0);
    for (const int dim : {2, 3}) {
      for (const double r : {0.9 * dp, 0.5 * dp, 0.05 * dp, -0.2 * dp}) {
        CAPTURE(r);
        const double step = 1e-5 * dp;
        const auto energy = [&](double at) { return lennard_jones_energy(at, dp, 1e7, dim); };
        CHECK((energy(r - step) - energy(r + step)) / (2 * step) ==
              Approx(lennard_jones_force(r, dp, 1e7, dim)).epsilon(1e-6));
      }
      const auto ratio = [&](double r) {
        return lennard_jones_force(r, dp, 1e7, dim) / penalty_force(r, dp, 1e7, dim);
      };
      CHECK(ratio(0.9999 * dp) == Approx(1).epsilon(1e-3));
      CHECK(ratio(0.7 * dp) > 3);
    }
    // [Zhang2020] Eq. 12: p̄ (2⁶ − 2⁴)/r at r = dp/2
    CHECK(lennard_jones_force(0.5 * dp, dp, 1e7, 2) == Approx(0.5 * 1e7 * dp * dp * 48 / (0.5 * dp)));
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("wall: a wall acts on a body as a mirror image of the body would") {
    Scene alone = flying_block(), both = two_blocks();
    alone.walls = {wall("wall", {0, 0.3, 0}, {-1, 0, 0})};
    for (const MethodInfo& method : methods()) {
      for (const ContactLaw law : {ContactLaw::penalty, ContactLaw::lennard_jones, ContactLaw::impulse}) {
        CAPTURE(std::string(method.name));
        CAPTURE(std::string(name(law)));
        // finite elements support only `surface`
        if (has_elements(method)) continue;
        REQUIRE(supports(method, law));
        alone.contact = both.contact = law;
        const Settings settings = with_method(std::string(method.name));
        const Snapshot on_wall = state_after(120, alone, settings),
                       on_image = state_after(120, both, settings);
        double difference = 0, slowed = 0;
        for (std::size_t k = 0; k < on_wall.v.size(); ++k)
          difference = std::max(difference, std::abs(on_wall.v[k] - on_image.v[k]));
        for (std::size_t i = 0; i < on_wall.size(); ++i) slowed += on_wall.v[2 * i];
        const double speed = alone.bodies[0].velocity[0]({});
        CHECK(difference < 1e-6 * speed);
        CHECK(slowed < 0.8 * speed * static_cast<double>(on_wall.size()));
      }
    }
  }

  TEST_CASE("wall: a wall acts by penalty contact under `sph`") {
    Scene scene = flying_block();
    scene.walls = {wall("wall", {0, 0, 0}, {-1, 0, 0})};
    const auto after = [&](ContactLaw law) {
      scene.contact = law;
      return state_after(40, scene, with_method("enog")).v;
    };
    CHECK(after(ContactLaw::sph) == after(ContactLaw::penalty));
    CHECK(after(ContactLaw::sph) != after(ContactLaw::lennard_jones));
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("wall: a wall turns bodies back and its impulse is recorded") {
    Scene scene = disc_in_corner();
    for (const MethodInfo& method : methods()) {
      for (const ContactLaw law : method.contact_laws) {
        CAPTURE(std::string(method.name));
        CAPTURE(std::string(name(law)));
        scene.contact = law;
        const auto simulation = make_simulation(scene, with_method(std::string(method.name)));
        const Balance before = balance(simulation->snapshot(), scene);
        simulation->advance_to(10 * 0.008 / scene.materials[0].sound_speed());
        const Balance after = balance(simulation->snapshot(), scene);
        CHECK(after.of_walls.linear[1] > -1.1 * before.linear_momentum[1]);
        const MomentumChange changed = change(before, after);
        if (method.conserves.starts_with("linear momentum")) CHECK(changed.linear < 1e-12);
        if (method.conserves.find("angular momentum") != std::string_view::npos)
          CHECK(changed.angular < 1e-12);
        const double energy = (after.kinetic + after.strain) / before.kinetic;
        CHECK(energy < (method.name == "pf" ? 1.3 : 1.02));  // zigzags of pf are undamped
        if (method.conserves.find("energy") != std::string_view::npos && law != ContactLaw::impulse)
          CHECK(energy == Approx(1).epsilon(5e-3));
      }
    }
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("wall: the angular impulse about the origin uses the arm to the point of contact") {
    const double speed = 0.02 * ring_rubber().sound_speed();
    for (const int axis : {0, 1}) {
      CAPTURE(axis);
      const std::size_t along = static_cast<std::size_t>(axis), across = 1 - along;
      Scene scene = flying_block();
      Point centre{}, at{}, normal{};
      centre[along] = 5 * dp, centre[across] = 70 * dp, at[across] = -3 * dp, normal[along] = 1;
      scene.bodies[0].shapes = {
          Box{{centre[0] - 4 * dp, centre[1] - 4 * dp, 0}, {centre[0] + 4 * dp, centre[1] + 4 * dp, 0}}};
      scene.bodies[0].velocity = {};
      scene.bodies[0].velocity[along] = constant(-speed);
      scene.walls = {wall("wall", at, normal)};
      for (const ContactLaw law : {ContactLaw::penalty, ContactLaw::lennard_jones, ContactLaw::impulse}) {
        CAPTURE(std::string(name(law)));
        scene.contact = law;
        const Impulse given = state_after(200, scene, with_method("tl")).of_walls;
        CHECK(given.linear[along] > 0.1 * speed * 64 * dp * dp * ring_rubber().density);
        CHECK(given.linear[across] == 0);
        const double arm = axis == 1 ? centre[across] : -centre[across];
        CHECK(given.angular[2] == Approx(arm * given.linear[along]).scale(0).epsilon(1e-9));
      }
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("wall: a body that starts inside a wall is refused unless it is clamped there") {
    Scene scene = disc_in_corner();
    scene.walls.push_back(wall("roof", {0, 0.006, 0}, {0, -1, 0}));
    try {
      make_simulation(scene, with_method("tl"));
      FAIL("nothing was thrown");
    } catch (const SceneError& error) {
      CHECK(error.key == "wall.roof");
      for (const char* part : {"'disc'", "'roof'", "inside"})
        CHECK(std::string(error.what()).find(part) != std::string::npos);
    }
    scene.bodies[0].clamped = [](const Point& x) { return x[1] > 0.0059 ? 1.0 : 0.0; };
    CHECK_NOTHROW(make_simulation(scene, with_method("tl")));
  }

  TEST_CASE("wall: a face of a body may start at most a quarter of a spacing inside a wall") {
    Scene scene = flying_block();
    const auto begins = [&](double depth) {
      scene.walls = {wall("front", {(-0.2 - depth) * dp, 0, 0}, {-1, 0, 0})};
      try {
        make_simulation(scene, with_method("tl"));
        return true;
      } catch (const SceneError& error) {
        CHECK(error.key == "wall.front");
        CHECK(std::string(error.what()).find("starts inside the wall") != std::string::npos);
        return false;
      }
    };
    CHECK(begins(0));
    CHECK(begins(0.25));
    CHECK_FALSE(begins(0.26));
    CHECK_FALSE(begins(0.49));
    scene.jitter = {0.4, 1};  // jitter does not move faces
    CHECK(begins(0));
    CHECK_FALSE(begins(0.3));
    scene.jitter = {};
    const Body block = scene.bodies[0];
    scene.bodies[0].shapes = {Box{{-9 * dp, 0, 0}, {-8 * dp, dp, 0}}, Disc{{-4 * dp, 0, 0}, 3.56 * dp}};
    scene.walls = {wall("front", {-0.44 * dp, 0, 0}, {-1, 0, 0})};
    CHECK_NOTHROW(make_simulation(scene, with_method("enog")));
    scene.bodies[0] = block;
    scene.bodies[0].on_boundary = true;
    CHECK(begins(0));
    scene.bodies[0].on_boundary = false;
    scene.bodies[0].displacement[0] = constant(-0.3 * dp);
    CHECK(begins(0.5));
  }
}

}  // namespace of_this_file
