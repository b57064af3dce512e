
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/scene/shapes/box.hpp"
#include "engine/scene/shapes/round_shapes.hpp"
#include "tests/support/runs.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double nu_stiff = 0.4, soft = 1e6;
constexpr double L = 0.05, H = 0.01;  // length of each half, and thickness of the vibrating bar

/// Poisson's ratio of the soft half with which both halves contract equally.
double matched(double ratio) { return (std::sqrt(1 + 4 * nu_stiff * (1 + nu_stiff) / ratio) - 1) / 2; }
double plane_modulus(double E, double nu) { return E / (1 - nu * nu); }

/// Stiff at x > 0 (`axis` 0) or y > 0 (`axis` 1).
Scene bar(double ratio, double nu_soft, int axis, double spacing, double half = H) {
  Scene scene;
  scene.name = "bar";
  scene.spacing = spacing;
  scene.materials = {{"soft", 1000, soft, nu_soft}, {"stiff", 1000, soft * ratio, nu_stiff}};
  Body body;
  body.name = "bar";
  body.shapes = {Box{{-L, -half, 0}, {L, half, 0}}};
  body.parts = {{1, [axis](const Point& x) { return x[axis] > 0 ? 1.0 : 0.0; }}};
  scene.bodies = {body};
  return scene;
}

/// Greatest force on a particle away from faces, divided by `traction` · dp.
double force_left(const Scene& scene, double traction) {
  const Snapshot now = state_after(1, scene, with_method("oenog"));
  const Box box = *scene.bodies[0].shapes[0].as<Box>();
  double greatest = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double from_face =
        std::min(box.high[0] - std::abs(now.x0[2 * i]), box.high[1] - std::abs(now.x0[2 * i + 1]));
    if (from_face < 4 * scene.spacing) continue;
    const double mass = 1000 * scene.spacing * scene.spacing;
    greatest = std::max(greatest, mass * std::hypot(now.v[2 * i], now.v[2 * i + 1]) / now.time);
  }
  return greatest / (traction * scene.spacing);
}

/// Lowest longitudinal frequency of the free bar in Hz, with transverse inertia ([Love] §278), in plane strain:
/// (M − ρ ω² (ν′ r)²) u″ + ρ ω² u = 0, ν′ = ν/(1 − ν), r² = H²/12.
double lowest_frequency(double ratio) {
  struct Wave {
    double k, Z;  // 1/m; traction over velocity
  };
  const auto wave = [](double E, double nu, double omega) {
    const double across = nu / (1 - nu);
    const double M = plane_modulus(E, nu) - 1000 * across * across * H * H / 12 * omega * omega;
    return Wave{omega * std::sqrt(1000 / M), std::sqrt(1000 * M)};
  };
  const auto mismatch = [&](double omega) {
    const Wave a = wave(soft, matched(ratio), omega), b = wave(soft * ratio, nu_stiff, omega);
    return a.Z * std::sin(a.k * L) * std::cos(b.k * L) + b.Z * std::sin(b.k * L) * std::cos(a.k * L);
  };
  double below = 100, above = below;
  while (mismatch(above) > 0) above += 10;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (below + above) / 2;
    (mismatch(middle) > 0 ? below : above) = middle;
  }
  return above / (2 * std::numbers::pi);
}

/// In Hz, from five periods.
double measured_frequency(double ratio, double spacing) {
  Scene scene = bar(ratio, matched(ratio), 0, spacing, H / 2);
  const double expected = lowest_frequency(ratio), omega = 2 * std::numbers::pi * expected;
  const double k = omega * std::sqrt(1000 / plane_modulus(soft, matched(ratio))),
               k_stiff = omega * std::sqrt(1000 / plane_modulus(soft * ratio, nu_stiff));
  scene.bodies[0].displacement[0] = [=](const Point& x) {
    return 1e-6 * (x[0] < 0 ? std::cos(k * (x[0] + L)) / std::cos(k * L)
                            : std::cos(k_stiff * (L - x[0])) / std::cos(k_stiff * L));
  };
  const auto simulation = make_simulation(scene, with_method("oenog"));
  double before = 0, time_before = 0;
  std::vector<double> crossings;
  while (crossings.size() < 11) {
    simulation->advance_to(simulation->time() + 0.002 / expected);
    const Snapshot now = simulation->snapshot();
    double ends = 0;  // Σ u sign(x) near the ends
    for (std::size_t i = 0; i < now.size(); ++i)
      ends += (now.x[2 * i] - now.x0[2 * i]) * (now.x0[2 * i] < -0.8 * L  ? -1
                                                : now.x0[2 * i] > 0.8 * L ? 1
                                                                          : 0);
    if (before * ends < 0)
      crossings.push_back(time_before + (now.time - time_before) * before / (before - ends));
    before = ends, time_before = now.time;
  }
  return 5 / (crossings.back() - crossings.front());
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("oenog: layers of two materials leave no force where they meet") {
    const double strain = 1e-6;
    for (const double ratio : {2.0, 10.0}) {
      CAPTURE(ratio);
      SUBCASE("in series under tension") {
        const double nu = matched(ratio), M = plane_modulus(soft, nu);
        Scene scene = bar(ratio, nu, 0, 0.001);
        const double of_stiff = M / plane_modulus(soft * ratio, nu_stiff);
        scene.bodies[0].displacement[0] = [=](const Point& x) {
          return strain * x[0] * (x[0] > 0 ? of_stiff : 1);
        };
        scene.bodies[0].displacement[1] = [=](const Point& x) { return -strain * nu / (1 - nu) * x[1]; };
        CHECK(force_left(scene, strain * M) < 1e-4);
      }
      SUBCASE("in parallel under tension") {
        Scene scene = bar(ratio, nu_stiff, 1, 0.001);
        scene.bodies[0].displacement[0] = [=](const Point& x) { return strain * x[0]; };
        scene.bodies[0].displacement[1] = [=](const Point& x) {
          return -strain * nu_stiff / (1 - nu_stiff) * x[1];
        };
        CHECK(force_left(scene, strain * plane_modulus(soft, nu_stiff)) < 1e-4);
      }
      SUBCASE("under shear") {
        Scene scene = bar(ratio, 0.3, 0, 0.001);
        const double G = soft / 2 / 1.3, of_stiff = G / (soft * ratio / 2 / (1 + nu_stiff));
        scene.bodies[0].displacement[1] = [=](const Point& x) {
          return strain * x[0] * (x[0] > 0 ? of_stiff : 1);
        };
        CHECK(force_left(scene, strain * G) < 1e-4);
      }
    }
  }

  TEST_CASE("oenog: in 3D the stress shown beside an interface belongs to its own side") {
    constexpr double strain = 1e-3, dp = 0.001, ratio = 5;
    Scene scene = bar(ratio, 0, 0, dp);
    scene.dim = 3;
    scene.materials[1].poisson_ratio = 0;
    scene.bodies[0].shapes = {Box{{-8 * dp, -3 * dp, -3 * dp}, {8 * dp, 3 * dp, 3 * dp}}};
    scene.bodies[0].displacement[0] = [](const Point& x) { return strain * x[0] / (x[0] > 0 ? ratio : 1); };
    const Snapshot now = make_simulation(scene, with_method("oenog"))->snapshot();
    for (std::size_t i = 0; i < now.size(); ++i) {
      CHECK(std::abs(now.stress(i).xx / (strain * soft) - 1) < 2 * strain);
      CHECK(std::abs(now.stress(i).yy) < 2 * strain * strain * soft);
    }
  }

  TEST_CASE("oenog: bodies with a curved interface, or with curved layers across it, gain no energy") {
    constexpr double dp = 0.001;
    Scene scene;
    scene.spacing = dp;
    scene.materials = {{"soft", 1000, soft, 0.4}, {"stiff", 1000, 15 * soft, 0.2}};
    Body body;
    body.velocity = {[](const Point& x) { return 0.01 * std::sin(200 * x[1]); },
                     [](const Point& x) { return 0.01 * std::cos(150 * x[0]); }};
    SUBCASE("a stiff ball in a soft box") {
      scene.dim = 3;
      body.shapes = {Box{{0, 0, 0}, {12 * dp, 12 * dp, 12 * dp}}};
      body.parts = {{1, [](const Point& x) {
                       return std::hypot(x[0] - 6 * dp, x[1] - 6 * dp, x[2] - 6 * dp) < 4 * dp ? 1.0 : 0.0;
                     }}};
    }
    SUBCASE("half a ring") {
      body.shapes = {Ring{{10 * dp, 7 * dp, 0}, 4 * dp, 9 * dp, RoundLayout::aligned}};
      body.parts = {{1, [](const Point& x) { return x[0] > 10 * dp ? 1.0 : 0.0; }}};
    }
    SUBCASE("a part of a disc") {
      scene.materials[1].youngs_modulus = 4 * soft;
      body.shapes = {Disc{{10 * dp, 7 * dp, 0}, 9 * dp, RoundLayout::spaced}};
      body.parts = {{1, [](const Point& x) { return x[0] > 8.2 * dp ? 1.0 : 0.0; }}};
    }
    scene.bodies = {body};
    const auto simulation = make_simulation(scene, with_method("oenog"));
    const auto energy = [&] {
      const Balance now = balance(simulation->snapshot(), scene);
      return now.kinetic + now.strain;
    };
    const double given = energy();
    simulation->advance_to(0.0006);
    CHECK(energy() < 1.001 * given);
  }

  TEST_CASE("oenog: a bar whose halves differ in stiffness vibrates at the exact frequency") {
    for (const double ratio : {10.0, 100.0}) {
      CAPTURE(ratio);
      CHECK(std::abs(measured_frequency(ratio, 0.002) / lowest_frequency(ratio) - 1) < 2.5e-4);
    }
  }
}

}  // namespace of_this_file
