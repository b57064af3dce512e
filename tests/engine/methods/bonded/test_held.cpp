
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/methods/bonded/layout/constraints.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.02, omega = 1, length = 0.7, half = 0.05;

Scene bar(int dim, double clamped_to) {
  Scene scene;
  scene.dim = dim;
  scene.spacing = dp;
  scene.materials = {{"stiff", /*ρ0*/ 1000, /*E*/ 3e7, /*ν*/ 0.3}};
  Body body;
  body.shapes = {Box{{-half, -half, -half}, {length - half, half, half}}};
  body.clamped = [=](const Point& x) {
    return x[0] * x[0] + x[1] * x[1] < clamped_to * clamped_to ? 1.0 : 0.0;
  };
  body.velocity[0] = [](const Point& x) { return -omega * x[1]; };
  body.velocity[1] = [](const Point& x) { return omega * x[0]; };
  scene.bodies = {body};
  Probe turn = make_probe("turn", Probe::Kind::turn), pull = make_probe("pull", Probe::Kind::reaction);
  turn.at = {length - 2 * half, 0, 0};
  turn.turns_about = {0, 0, 1};
  scene.probes = {turn, pull};
  return scene;
}

double turned(const Scene& scene, const char* method, double t) {
  const auto simulation = make_simulation(scene, with_method(method));
  simulation->advance_to(t);
  return simulation->series().value[0].back();
}

/// Reaction at the pulled end of a bar, divided by E A u/L. With `both`, the left end is driven at speed 0.
double resistance(double spacing, bool both, const char* method, std::optional<double> until = {}) {
  constexpr double E = 1e6, clamp = 0.004, width = 0.012, free = 0.032, u = 1e-5;
  Scene scene;
  scene.spacing = spacing;
  scene.damping = 200;
  scene.materials = {{"soft", /*ρ0*/ 1000, E, /*ν*/ 0}};
  Body body;
  body.shapes = {Box{{0, 0, 0}, {free + 2 * clamp, width, 0}}};
  const Expression left = [](const Point& x) { return x[0] < clamp ? 1.0 : 0.0; };
  const Expression right = [](const Point& x) { return x[0] > clamp + free ? 1.0 : 0.0; };
  Drive drive;
  drive.where = right;
  drive.velocity[0] = [](double t) { return t < 0.02 ? u / 0.02 : 0.0; };
  drive.until = until;
  body.drives = {drive};
  if (both)
    body.drives.push_back({left, {}, until});
  else
    body.clamped = left;
  scene.bodies = {body};
  Probe force = make_probe("force", Probe::Kind::reaction);
  force.where = right;
  scene.probes = {force};
  const auto simulation = make_simulation(scene, with_method(method));
  simulation->advance_to(0.12);
  return std::abs(simulation->series().value[0].back()) / (E * width * u / free);
}

/// A clamped column whose top starts at speed V.
Scene column(int dim, double spacing, double V) {
  constexpr double length = 4;
  Scene scene;
  scene.dim = dim;
  scene.spacing = spacing;
  scene.materials = {{"rubber", /*ρ0*/ 1100, /*E*/ 17e6, /*ν*/ 0.45}};
  Body body;
  body.shapes = {Box{{-0.5, 0, -0.5}, {0.5, length, 0.5}}};
  body.on_boundary = true;
  body.clamped = [](const Point& x) { return x[1] <= 1e-9 ? 1.0 : 0.0; };
  body.velocity[0] = [=](const Point& x) { return V * x[1] / length; };
  scene.bodies = {body};
  Probe top = make_probe("top", Probe::Kind::displacement);
  top.at = {0, length, 0};
  scene.probes = {top};
  return scene;
}

/// Time at which the top of the column comes back to its start.
double half_period(int dim, double spacing, const char* method) {
  const auto simulation = make_simulation(column(dim, spacing, /*V*/ 0.1), with_method(method));
  simulation->advance_to(0.5);
  const Series& series = simulation->series();
  const std::vector<double>& d = series.value[0];
  for (std::size_t n = 2; n < d.size(); ++n)
    if (d[n] < 0) return series.time[n] + (series.time[n - 1] - series.time[n]) * d[n] / (d[n] - d[n - 1]);
  return 0;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("clamp: columns of particles on their faces swing as with finite elements") {
    CHECK(half_period(2, 1.0 / 8, "oenog") == relative(half_period(2, 1.0 / 8, "fe2"), 5e-3));
    CHECK(half_period(3, 1.0 / 5, "oenog") == relative(half_period(3, 1.0 / 5, "fe2"), 5e-3));
  }

  TEST_CASE(
      "driven: in oenog a region driven to the end acts as a clamp, one released later as a clamp 0.4 dp farther away") {
    for (const double spacing : {0.002, 0.001}) {
      CAPTURE(spacing);
      const double length = 0.032, later = 1;
      for (const bool both : {false, true}) {
        CAPTURE(both);
        const double farther = (both ? 0.78 : 0.39) * spacing;
        CHECK(resistance(spacing, both, "oenog") == relative(1, 1e-3));
        CHECK(resistance(spacing, both, "oenog", later) == relative(1 / (1 + farther / length), 1e-3));
        CHECK(resistance(spacing, both, "tl") == relative(1 / (1 + 2 * spacing / length), 1e-3));
      }
      CHECK(resistance(spacing, true, "tl") == relative(resistance(spacing, false, "tl"), 1e-9));
      CHECK(resistance(spacing, false, "tl", later) == relative(resistance(spacing, false, "tl"), 1e-9));
    }
  }

  TEST_CASE("driven: a driven face has stress, and a later release does not change the earlier state") {
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      Scene scene = bar(dim, 0);
      scene.until = 1;
      Body& body = scene.bodies[0];
      body.on_boundary = true;
      body.clamped = [](const Point& x) { return x[0] < -half + 0.1 * dp ? 1.0 : 0.0; };
      body.velocity = {};
      Drive drive;
      drive.where = [](const Point& x) { return x[0] > length - half - 0.1 * dp ? 1.0 : 0.0; };
      drive.velocity[1] = [](double) { return 1.0; };
      body.drives = {drive};
      const Snapshot lasting = state_after(100, scene, with_method("oenog"));
      body.drives[0].until = 0.5;
      const Snapshot let_go = state_after(100, scene, with_method("oenog"));
      CHECK(lasting.x == let_go.x);
      CHECK(lasting.s == let_go.s);
      double greatest = 0;
      for (std::size_t i = 0; i < lasting.size(); ++i)
        if (lasting.driven[i]) greatest = std::max(greatest, std::abs(lasting.stress(i).xy));
      CHECK(greatest > 0);
    }
  }

  TEST_CASE("driven: a rigid region exerts no force on a clamp beside it") {
    constexpr double speed = 1;
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      Scene scene = bar(dim, 0);
      Body& body = scene.bodies[0];
      body.clamped = [](const Point& x) { return x[0] < 0.3 ? 1.0 : 0.0; };
      body.velocity = {};
      Drive drive;
      drive.where = [](const Point& x) { return x[0] > 0.3 ? 1.0 : 0.0; };
      drive.velocity[0] = [](double) { return speed; };
      body.drives = {drive};
      const auto simulation = make_simulation(scene, with_method("oenog"));
      simulation->advance_to(2 * dp / speed);
      const double unit = scene.materials[0].youngs_modulus * 4 * half * half;
      CHECK(std::abs(simulation->series().value[1].back()) < 1e-12 * unit);
    }
  }

  TEST_CASE("pins: a bar keeps rotating about one clamped particle, in 3D about a row") {
    const double t = 0.4;
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      const Scene scene = bar(dim, 0.3 * dp);
      CHECK(turned(scene, "oenog", t) == relative(omega * t, 2e-3));
      CHECK(turned(scene, "tl", t) == relative(omega * t, 2e-3));
    }
    CHECK(std::abs(turned(bar(2, 1.2 * dp), "oenog", t)) < 0.2 * omega * t);  // a clamped block of five
  }

  TEST_CASE("pins: the reaction at a pin is the centripetal force of the bar's mass") {
    const auto simulation = make_simulation(bar(2, 0.3 * dp), with_method("oenog"));
    simulation->advance_to(0.3);
    const Series& series = simulation->series();
    double impulse = 0;
    for (std::size_t n = 1; n < series.time.size(); ++n)
      impulse += series.value[1][n] * (series.time[n] - series.time[n - 1]);
    const double mass = 1000 * length * 2 * half, centre = 0.5 * length - half;
    CHECK(impulse == relative(mass * omega * centre * -std::sin(omega * 0.3), 0.03));
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("clamp: a column of particles on its faces keeps its energy while it swings far") {
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      Settings settings = with_method("oenog");
      settings.constants["damping"] = 0;
      settings.cfl = 0.2;
      const Scene scene = column(dim, /*dp*/ 0.25, /*V*/ 10);
      const auto simulation = make_simulation(scene, settings);
      const auto energy = [&] {
        const Balance now = balance(simulation->snapshot(), scene);
        return now.kinetic + now.strain;
      };
      const double at_start = energy();
      for (const double t : {0.1, 0.2, 0.3}) {
        simulation->advance_to(t);
        CHECK(energy() == relative(at_start, 1e-4));
      }
    }
  }
}

TEST_SUITE("term") {
  TEST_CASE("clamp: a uniform strain leaves no force on the particles in front of its face") {
    constexpr double size = 1e-3;  // of strains that keep the clamp's face fixed
    for (const int dim : {2, 3}) {
      for (const std::size_t along : {0, 1}) {
        CAPTURE(dim);
        CAPTURE(along);
        Scene scene = bar(dim, 0);
        scene.bodies[0].shapes = {Box{{-3 * dp, -0.1, -0.1}, {0.2, 0.1, 0.1}}};
        scene.bodies[0].clamped = [](const Point& x) { return x[0] < 0 ? 1.0 : 0.0; };
        scene.bodies[0].velocity = {};
        scene.bodies[0].displacement[along] = [](const Point& x) { return std::max(size * x[0], 0.0); };
        scene.probes.clear();
        const auto simulation = make_simulation(scene, with_method("oenog"));
        make_steps(*simulation, 1);
        const Snapshot& now = simulation->snapshot();
        const double unit = size * scene.materials[0].shear_modulus() / (scene.materials[0].density * dp);
        double greatest = 0;
        for (std::size_t i = 0; i < now.size(); ++i) {
          const Point X = now.initial(i);
          const bool before =
              X[0] > 0 && X[0] < 3 * dp && std::abs(X[1]) < dp && (dim == 2 || std::abs(X[2]) < dp);
          if (before) greatest = std::max(greatest, std::abs(now.velocity(i)[along]) / (unit * now.time));
        }
        CHECK(greatest < 1e-3);
      }
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("pins: one particle in 2D and a row in 3D are pins, a block and a face are not") {
    const auto count = [](const Scene& scene) {
      const InitialParticles initial = make_initial_particles(scene);
      return std::ranges::count(make_constraints(scene, initial), Constraint::pinned);
    };
    CHECK(count(bar(2, 0.3 * dp)) == 1);
    CHECK(count(bar(3, 0.3 * dp)) == 5);
    CHECK(count(bar(2, 1.2 * dp)) == 0);
    CHECK(count(bar(3, 1.2 * dp)) == 0);
    Scene face = bar(2, 0);
    face.bodies[0].clamped = [](const Point& x) { return x[0] < -half + dp ? 1.0 : 0.0; };
    CHECK(count(face) == 0);
  }
}

}  // namespace of_this_file
