#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr int steps = 300;
constexpr double round_off = 1e-13;  // relative change over all steps

bool claims(const MethodInfo& method, const char* what) {
  return method.conserves.find(what) != std::string_view::npos;
}

double linear_change(const Balance& before, const Balance& after) {
  return std::hypot(after.linear_momentum[0] - before.linear_momentum[0],
                    after.linear_momentum[1] - before.linear_momentum[1]) /
         before.momentum_scale;
}

double angular_change(const Balance& before, const Balance& after) {
  return std::abs(after.angular_momentum[2] - before.angular_momentum[2]) / before.angular_scale;
}

double slowed(const Snapshot& start, const Snapshot& end) {
  double before = 0, after = 0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (start.body[i] != 0) continue;
    before += start.m[i] * start.v[2 * i];
    after += end.m[i] * end.v[2 * i];
  }
  return 1 - after / before;
}

bool keeps_linear_momentum(const MethodInfo& method) { return !method.name.ends_with("tic"); }

/// With `tic` the thin ring bursts after some 90 steps.
int collision_steps(const MethodInfo& method) { return method.name.ends_with("tic") ? 80 : steps; }

const std::map<std::string, double> least_angular_change = {
    {"og", 0.03},
    {"oas", 0.01},
    {"enog", 0.2},
    {"enog-nonconservative", 0.8},
    {"gnog", 0.005},
    {"gnog-amc", 0.001},
    {"ulsph-av-as-uncorrected", 0.05},
    {"ulsph-av-as", 8e-5},
    {"d-ulsph-av-as", 8e-5},
    {"d-ulsph-av-tic", 2e-4},
    {"d-ulsph-r-as", 3e-5},
    {"ulsph-r-tic", 1e-3},
    {"d-ulsph-r-tic", 1e-3},
    {"ccb", 0.09},
    {"ccbwat", 0.07},
    {"tl-enog", 8e-6},
    {"tl-small-strain", 0.002},
};

/// ccb does not damp tension, pf does not damp zigzags; tl-small-strain and the contact of fe2 have time step errors.
double greatest_energy_gain(std::string_view method) {
  if (method == "fe2") return 0.02;
  if (method == "ccb") return 0.2;
  if (method == "pf") return 5;
  return method == "tl-small-strain" ? 0.003 : 0;
}

}  // namespace

TEST_SUITE("conservation") {
  TEST_CASE("linear momentum: in a collision exactly the methods that claim it conserve it to round-off") {
    const Scene scene = small_collision();
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      REQUIRE(claims(method, "linear momentum") == keeps_linear_momentum(method));
      for (const Stepping stepping : {Stepping::dual, Stepping::single}) {
        const auto simulation = make_simulation(scene, with_method(std::string(method.name), stepping));
        const Snapshot start = simulation->snapshot();
        make_steps(*simulation, collision_steps(method));
        const Balance before = balance(start, scene), after = balance(simulation->snapshot(), scene);
        if (keeps_linear_momentum(method))
          CHECK(linear_change(before, after) < round_off);
        else
          CHECK(linear_change(before, after) > 1e-3);
        CHECK(slowed(start, simulation->snapshot()) > 0.3);
      }
    }
  }

  TEST_CASE("momenta: exactly the methods that claim it conserve the angular momentum of a rotating plate") {
    const Scene scene = rotating_plate(0.2);
    for (const MethodInfo& method : methods()) {
      const std::string name(method.name);
      CAPTURE(name);
      const auto simulation = make_simulation(scene, with_method(name));
      const Balance before = balance(simulation->snapshot(), scene);
      CHECK(before.angular_momentum[2] > 0.99 * before.angular_scale);
      make_steps(*simulation, steps);
      const Balance after = balance(simulation->snapshot(), scene);
      CHECK(linear_change(before, after) < round_off);
      if (claims(method, "angular momentum"))
        CHECK(angular_change(before, after) < round_off);
      else
        CHECK(angular_change(before, after) > least_angular_change.at(name));
    }
  }

  TEST_CASE("angular momentum: corrected kernel gradients conserve it, the artificial stress does not") {
    // the torque is the antisymmetric part of Σ V_i σ_i·L_i·M_i, which is 0 because L_i·M_i = I
    const Scene scene = rotating_plate(0.2);
    const auto change = [&](const std::string& method, double epsilon) {
      Settings settings = with_method(method);
      settings.constants["epsilon"] = epsilon;
      const auto simulation = make_simulation(scene, settings);
      const Balance before = balance(simulation->snapshot(), scene);
      make_steps(*simulation, 100);
      return angular_change(before, balance(simulation->snapshot(), scene));
    };
    for (const std::string method : {"ulsph-av-as", "d-ulsph-av-as", "d-ulsph-r-as"}) {
      CAPTURE(method);
      CHECK(change(method, 0) < round_off);
      CHECK(change(method, 0.15) > 1e-6);
    }
    CHECK(change("ulsph-av-as-uncorrected", 0) > 1e-3);
    CHECK(change("ccbwat", 0) > 1e-3);
  }

  TEST_CASE("slow rotation: gnog-amc changes energy and angular momentum less than gnog") {
    Scene scene = rotating_plate(0.03);
    scene.spacing = 0.002;
    const auto greatest = [&](const std::string& method, double until) {
      const auto simulation = make_simulation(scene, with_method(method));
      const Balance before = balance(simulation->snapshot(), scene);
      double gained = 0, turned = 0;
      for (int k = 1; k <= 50; ++k) {
        simulation->advance_to(k * until / 50);
        const Balance now = balance(simulation->snapshot(), scene);
        gained = std::max(gained, (now.kinetic + now.strain) / before.kinetic - 1);
        turned = std::max(turned, angular_change(before, now));
      }
      return std::pair{gained, turned};
    };
    const auto [gained, turned] = greatest("gnog-amc", 0.05);  // two turns
    CHECK(gained < 1e-3);
    CHECK(turned < 0.25);
    const auto [gained_by_gnog, turned_by_gnog] = greatest("gnog", 0.005);
    CHECK(gained_by_gnog > 0.5);
    CHECK(turned_by_gnog > 0.35);
  }

  TEST_CASE("linear momentum: gnog-amc does not conserve it if the penalty rotates with each particle") {
    const Scene scene = small_collision();
    Settings settings = with_method("gnog-amc");
    settings.constants["penalty_rotation"] = 1;
    const auto simulation = make_simulation(scene, settings);
    const Balance before = balance(simulation->snapshot(), scene);
    make_steps(*simulation, steps);
    CHECK(linear_change(before, balance(simulation->snapshot(), scene)) > 1e-5);
  }

  TEST_CASE("energy: a collision gains no energy beyond each method's known error") {
    const Scene scene = small_collision();
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const auto simulation = make_simulation(scene, with_method(std::string(method.name)));
      const Balance before = balance(simulation->snapshot(), scene);
      make_steps(*simulation, collision_steps(method));
      const Balance after = balance(simulation->snapshot(), scene);
      CHECK(after.kinetic + after.strain < (1 + greatest_energy_gain(method.name)) * before.kinetic);
      CHECK(after.kinetic + after.strain > 0.1 * before.kinetic);
    }
  }

  TEST_CASE("free flight: an unstrained body keeps every velocity and stays unstressed") {
    Scene scene = small_collision();
    scene.bodies.pop_back();
    const double speed = 0.1 * scene.materials[0].sound_speed();
    scene.bodies[0].velocity = {constant(speed), constant(-0.5 * speed), {}};
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const Snapshot now = state_after(steps, scene, with_method(std::string(method.name)));
      double change = 0, stress = 0;
      for (std::size_t i = 0; i < now.size(); ++i) {
        change = std::max({change, std::abs(now.v[2 * i] - speed), std::abs(now.v[2 * i + 1] + 0.5 * speed)});
        stress = std::max({stress, std::abs(now.p[i]), std::abs(now.s[4 * i]), std::abs(now.s[4 * i + 1])});
      }
      CHECK(now.x[0] - now.x0[0] > scene.spacing);
      // strains computed from positions have the round-off of x, relative to the spacing
      const double bound = keeps_neighbors(method) ? 100 * round_off : round_off;
      CHECK(change < bound * speed);
      CHECK(stress < bound * scene.materials[0].youngs_modulus);
    }
  }

  TEST_CASE("mass: snapshots keep the mass and initial position of every particle") {
    const Scene scene = small_collision();
    const auto simulation = make_simulation(scene, with_method("enog"));
    const Snapshot start = simulation->snapshot();
    make_steps(*simulation, steps);
    CHECK(simulation->snapshot().m == start.m);
    CHECK(simulation->snapshot().x0 == start.x);
  }

  TEST_CASE("clamped particles: every method keeps their positions to the last bit") {
    const Scene scene = small_clamped_plate();
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const auto simulation = make_simulation(scene, with_method(std::string(method.name)));
      make_steps(*simulation, steps);
      const Snapshot& now = simulation->snapshot();
      int clamped = 0, moved = 0;
      for (std::size_t i = 0; i < now.size(); ++i) {
        if (!now.clamped[i]) continue;
        ++clamped;
        moved += now.x[2 * i] != now.x0[2 * i] || now.x[2 * i + 1] != now.x0[2 * i + 1];
      }
      CHECK(clamped == (method.name == "fe2" ? 7 : has_elements(method) ? 6 : 4) * 5);
      CHECK(moved == 0);
    }
  }
}

}  // namespace of_this_file
