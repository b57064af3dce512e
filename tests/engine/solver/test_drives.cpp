#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.001;
constexpr double length = 0.04;
constexpr double push = 0.00005;
constexpr double stroke = 2e-5;

double piston(double t) { return stroke / push * (1 - std::cos(2 * 3.14159265358979323846 * t / push)); }

Scene pushed_bar() {
  Scene scene;
  scene.name = "pushed-bar";
  scene.spacing = dp;
  scene.until = 4 * push;
  scene.materials = {ring_rubber()};
  Body bar;
  bar.name = "bar";
  bar.shapes = {Box{{0, 0, 0}, {length, 5 * dp, 0}}};
  Drive drive;
  drive.where = [](const Point& x) { return x[0] < 2 * dp ? 1.0 : 0.0; };
  drive.velocity[0] = piston;
  drive.until = push;
  bar.drives = {drive};
  scene.bodies = {bar};
  return scene;
}

double energy(const Balance& sums) { return sums.kinetic + sums.strain; }

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("driven: points in a driven or clamped region or on its edge follow the region to round-off") {
    for (const int layers : {1, 2}) {
      for (const char* method : {"oenog", "enog"}) {
        CAPTURE(layers);
        CAPTURE(method);
        Scene scene = pushed_bar();
        scene.bodies[0].drives[0].where = [=](const Point& x) { return x[0] < layers * dp ? 1.0 : 0.0; };
        scene.bodies[0].clamped = [=](const Point& x) { return x[0] > length - layers * dp ? 1.0 : 0.0; };
        const std::vector<Point> driven = {
            {0, 2.5 * dp, 0}, {0.5 * dp, 0.5 * dp, 0}, {layers * dp, 2 * dp, 0}};
        for (const Point& at : driven) {
          for (const double place : {at[0], length - at[0]}) {
            Probe probe = make_probe("x", Probe::Kind::displacement);
            probe.at = {place, at[1], 0};
            scene.probes.push_back(probe);
          }
        }
        const auto simulation = make_simulation(scene, with_method(method));
        simulation->advance_to(0.6 * push);
        const Snapshot& now = simulation->snapshot();
        const double way = now.x[0] - now.x0[0];
        CHECK(way > 0.5 * stroke);
        for (std::size_t k = 0; k < scene.probes.size(); ++k)
          CHECK(std::abs(simulation->series().value[k].back() - (k % 2 == 0 ? way : 0)) < 1e-12 * dp);
      }
    }
  }

  TEST_CASE("driven: a piston moves as prescribed to second order in every method and is then free") {
    const Scene scene = pushed_bar();
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      Settings settings = with_method(std::string(method.name));
      const auto error = [&](double cfl) {
        settings.cfl = cfl;
        const auto simulation = make_simulation(scene, settings);
        simulation->advance_to(0.6 * push);
        const Snapshot& now = simulation->snapshot();
        // symplectic Euler has velocities at mid-step
        const double middle = now.time - 0.5 * now.time / static_cast<double>(now.step);
        CHECK(std::min(std::abs(now.v[0] - piston(now.time)), std::abs(now.v[0] - piston(middle))) <
              1e-12 * piston(now.time));
        CHECK(now.v[1] == 0);
        const double phase = 2 * 3.14159265358979323846 * now.time / push;
        return std::abs(now.x[0] - now.x0[0] - stroke / push * now.time +
                        stroke / (2 * 3.14159265358979323846) * std::sin(phase));
      };
      const double coarse = error(0.1), fine = error(0.025);
      CHECK(coarse < 0.01 * stroke);
      CHECK(fine < coarse / 8);
      const auto simulation = make_simulation(scene, settings);
      simulation->advance_to(2 * push);
      CHECK(simulation->snapshot().v[0] != 0);
    }
  }
}

TEST_SUITE("conservation") {
  TEST_CASE(
      "driven: the energy of a bar is its piston's work if the method conserves energy, else at most 1 % greater") {
    const Scene scene = pushed_bar();
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      Settings settings = with_method(std::string(method.name));
      settings.cfl = 0.1;
      const auto simulation = make_simulation(scene, settings);
      const double at_rest = energy(balance(simulation->snapshot(), scene));
      simulation->advance_to(push);
      const Balance driven = balance(simulation->snapshot(), scene);
      CHECK(driven.work > 1e9 * at_rest);
      // ccb is undamped in tension
      CHECK(energy(driven) < (method.name == "ccb" ? 1.01 : 1.001) * driven.work);
      CHECK(energy(driven) > 0.5 * driven.work);
      simulation->advance_to(2 * push);
      CHECK(balance(simulation->snapshot(), scene).work == driven.work);
      if (method.conserves.find("energy") == std::string_view::npos) continue;
      CHECK(energy(driven) == Approx(driven.work).epsilon(1e-3));
    }
  }

  TEST_CASE(
      "driven: without dissipation the work of a piston that never releases the bar is the energy of the bar") {
    Scene scene = pushed_bar();
    scene.bodies[0].drives[0].until = {};
    for (const MethodInfo& method : methods()) {
      const bool bonded = method.formulation.family == Family::bonded;
      if (!bonded && method.conserves.find("energy") == std::string_view::npos) continue;
      CAPTURE(std::string(method.name));
      Settings settings = with_method(std::string(method.name));
      settings.cfl = 0.1;
      if (bonded) settings.constants["damping"] = 0;
      const auto simulation = make_simulation(scene, settings);
      for (const double t : {push, 2 * push, scene.until}) {
        simulation->advance_to(t);
        const Balance now = balance(simulation->snapshot(), scene);
        CHECK(energy(now) == Approx(now.work).epsilon(1e-3));
      }
    }
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("driven: a body driven against gravity at constant speed receives no net work in any method") {
    Scene scene = pushed_bar();
    constexpr double speed = 0.3, g = 1000;
    scene.gravity[1] = [](double) { return -g; };
    scene.bodies[0].drives[0] = {constant(1), {nullptr, [](double) { return speed; }, nullptr}, scene.until};
    scene.bodies[0].velocity[1] = constant(speed);
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const auto simulation = make_simulation(scene, with_method(std::string(method.name)));
      simulation->advance_to(scene.until);
      const Balance now = balance(simulation->snapshot(), scene);
      const double against_weight = ring_rubber().density * length * 5 * dp * g * speed * scene.until;
      CHECK(std::abs(now.work) < 1e-9 * against_weight);
    }
  }

  TEST_CASE("driven: neither state nor work depends on the number of threads") {
    const Scene scene = pushed_bar();
    for (const char* method : {"enog", "oenog"}) {
      Settings settings = with_method(method);
      const Snapshot one = state_after(40, scene, settings);
      settings.threads = 3;
      const Snapshot three = state_after(40, scene, settings);
      CHECK(one.work > 0);
      CHECK(three.work == one.work);
      CHECK(three.x == one.x);
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("driven: a region driven with zero velocity equals a clamp") {
    Scene clamped = oscillating_plate(0.05, 4);
    clamped.until = 1;
    Scene driven = clamped;
    driven.bodies[0].clamped = {};
    const Expression velocity = clamped.bodies[0].velocity[1];
    driven.bodies[0].velocity[1] = [=](const Point& x) { return x[0] < 0 ? 0 : velocity(x); };
    driven.bodies[0].drives = {{.where = clamped.bodies[0].clamped, .velocity = {}, .until = {}}};
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const Snapshot one = state_after(60, clamped, with_method(std::string(method.name)));
      const Snapshot other = state_after(60, driven, with_method(std::string(method.name)));
      double off = 0, way = 0;
      for (std::size_t k = 0; k < one.x.size(); ++k) {
        off = std::max(off, std::abs(one.x[k] - other.x[k]));
        way = std::max(way, std::abs(one.x[k] - one.x0[k]));
      }
      CHECK(off < 1e-9 * way);
    }
  }
}

}  // namespace of_this_file
