#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/layout/initial_particles.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.001;
constexpr double length = 0.012, height = 0.006;
constexpr double period = 4 * length / 91;  // s; √(E/ρ) = 91 m/s
constexpr double rounding = 1e-12;

/// With `at_wall`, the left end is on rollers too.
Scene bar_on_rollers(bool at_wall) {
  Scene scene;
  scene.name = "bar-on-rollers";
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  const double speed = 0.05 * ring_rubber().sound_speed();
  Body bar;
  bar.name = "bar";
  bar.shapes = {Box{{0, 0, 0}, {length, height, 0}}};
  bar.guided[1] = [](const Point& x) { return x[1] < dp ? 1.0 : 0.0; };
  if (at_wall) bar.guided[0] = [](const Point& x) { return x[0] < dp ? 1.0 : 0.0; };
  bar.velocity[0] = [=](const Point& x) { return speed * (x[0] / length + 0.1 * shake(x, 5 * dp)); };
  bar.velocity[1] = [=](const Point& x) { return speed * 0.1 * shake(x, 7 * dp); };
  scene.bodies = {bar};
  return scene;
}

std::size_t on(std::size_t i, std::size_t axis) { return 2 * i + axis; }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("guides: guided particles have bits for their axes, clamped and free particles have no bits") {
    Scene scene = bar_on_rollers(true);
    InitialParticles layout = make_initial_particles(scene);
    REQUIRE(static_cast<int>(layout.guided.size()) == layout.size());
    for (int i = 0; i < layout.size(); ++i) {
      const bool x = layout.x[i][0] < dp, y = layout.x[i][1] < dp;
      CHECK(layout.guided[i] == (x ? 1 : 0) + (y ? 2 : 0));
      CHECK(layout.clamped[i] == 0);
      if (x) CHECK(layout.v[i][0] == 0);
      if (y) CHECK(layout.v[i][1] == 0);
      if (!x) CHECK(layout.v[i][0] != 0);
    }
    scene.bodies[0].clamped = [](const Point& x) { return x[0] < dp ? 1.0 : 0.0; };
    layout = make_initial_particles(scene);
    for (int i = 0; i < layout.size(); ++i)
      if (layout.clamped[i]) CHECK(layout.guided[i] == 0);
    scene.bodies[0].guided = {};
    CHECK(make_initial_particles(scene).guided.empty());
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("guides: in every method a stretched bar stays on its rollers, slides and contracts") {
    const Scene scene = bar_on_rollers(true);
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const auto simulation = make_simulation(scene, with_method(std::string(method.name)));
      simulation->advance_to(0.2 * period);
      const Snapshot& now = simulation->snapshot();
      double off = 0, slid = 0, contracted = 0, pulled = 0;
      for (std::size_t i = 0; i < now.size(); ++i) {
        const double x0 = now.x0[on(i, 0)], y0 = now.x0[on(i, 1)];
        const double ux = now.x[on(i, 0)] - x0, uy = now.x[on(i, 1)] - y0;
        if (x0 < dp) off = std::max({off, std::abs(ux), std::abs(now.v[on(i, 0)])});
        if (y0 < dp) off = std::max({off, std::abs(uy), std::abs(now.v[on(i, 1)])});
        if (y0 < dp && x0 > length - dp) slid = ux;
        if (x0 < dp && y0 > height - dp) contracted = uy;
        if (y0 > height - dp && x0 > length - dp) pulled = ux;
      }
      CHECK(off == 0);
      CHECK(slid > 0.01 * length);
      CHECK(slid == Approx(pulled).epsilon(0.2));
      CHECK(contracted < -0.003 * height);
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("guides: in 3D each guided component stays 0 in every method") {
    Scene scene = bar_on_rollers(true);
    scene.dim = 3;
    Body& bar = scene.bodies[0];
    bar.shapes = {Box{{0, 0, 0}, {length, height, height}}};
    bar.guided[2] = [](const Point& x) { return x[0] > length - dp ? 1.0 : 0.0; };
    bar.velocity[2] = bar.velocity[1];
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const Snapshot now = state_after(15, scene, with_method(std::string(method.name)));
      Scene meshed = scene;
      meshed.element_order = method.formulation.element_order;
      const InitialParticles layout = make_initial_particles(meshed);
      long constrained = 0;
      for (std::size_t i = 0; i < now.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          const bool still = now.initial(i)[k] == now.position(i)[k] && now.velocity(i)[k] == 0;
          const bool guided = (layout.guided[i] >> k & 1) != 0;
          constrained += guided;
          CHECK(still == guided);
        }
      }
      // the region of one layer of particles contains two layers of nodes
      CHECK(constrained == (has_elements(method) ? 2 * (7 * 7 + 13 * 7 + 7 * 7) : 6 * 6 + 12 * 6 + 6 * 6));
    }
  }
}

TEST_SUITE("conservation") {
  TEST_CASE(
      "guides: except with tic, momentum along rollers is conserved, and momentum across rollers is not") {
    const Scene scene = bar_on_rollers(false);
    for (const MethodInfo& method : methods()) {
      if (method.name.ends_with("tic")) continue;
      CAPTURE(std::string(method.name));
      const auto simulation = make_simulation(scene, with_method(std::string(method.name)));
      const Balance before = balance(simulation->snapshot(), scene);
      make_steps(*simulation, 200);
      const Balance after = balance(simulation->snapshot(), scene);
      const auto change = [&](std::size_t k) {
        return std::abs(after.linear_momentum[k] - before.linear_momentum[k]) / before.momentum_scale;
      };
      CHECK(change(0) < rounding);
      CHECK(change(1) > 1e-3);
    }
  }

  TEST_CASE("guides: rollers do no work, so a bar's energy is conserved") {
    const Scene scene = bar_on_rollers(true);
    for (const char* method : {"tl", "oenog"}) {
      CAPTURE(method);
      Settings settings = with_method(method);
      settings.cfl = 0.1;
      if (settings.method == "oenog") settings.constants["damping"] = 0;
      const auto simulation = make_simulation(scene, settings);
      const auto energy = [&] {
        const Balance now = balance(simulation->snapshot(), scene);
        return now.kinetic + now.strain;
      };
      const double before = energy();
      simulation->advance_to(period);
      CHECK(energy() == Approx(before).epsilon(0.002));
    }
  }

  TEST_CASE("guides: gravity along guided axes causes no motion and no work in any method") {
    Scene scene = bar_on_rollers(false);
    scene.bodies[0].guided[1] = constant(1);
    scene.bodies[0].velocity = {};
    scene.gravity[1] = [](double) { return -1000.0; };
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const Snapshot now = state_after(20, scene, with_method(std::string(method.name)));
      CHECK(now.work == 0);
      for (std::size_t i = 0; i < now.size(); ++i) {
        CHECK(std::abs(now.v[on(i, 0)]) < rounding);
        CHECK(now.v[on(i, 1)] == 0);
      }
    }
  }
}

}  // namespace of_this_file
