#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/error.hpp"
#include "engine/layout/outline.hpp"
#include "engine/scene/shapes/polygon.hpp"
#include "engine/terms/surface_contact.hpp"
#include "tests/support/closing_arms.hpp"
#include "tests/support/pressed.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.001;
constexpr double arm = 0.03;
using V = Vec<double, 2>;

double modulus() { return ring_rubber().bulk_modulus() + 4.0 / 3 * ring_rubber().shear_modulus(); }

Scene scene_of(const std::vector<Shape>& shapes) { return scene_of_shapes(shapes, 2, dp); }

Pressed<2> two_discs(double depth) {
  const double r = 0.006, angle = 0.7, apart = 2 * r - depth;
  return Pressed<2>(
      scene_of({Disc{{0, 0, 0}, r}, Disc{{apart * std::cos(angle), apart * std::sin(angle), 0}, r}}));
}

Scene two_blocks_that_meet() {
  Scene scene = scene_of({Box{{-0.008, 0, 0}, {0, 0.006, 0}}, Box{{0.0001, 0, 0}, {0.0081, 0.006, 0}}});
  scene.bodies[1].velocity[0] = constant(-8);
  return scene;
}

double total_energy(const Simulation& simulation, const Scene& scene) {
  const Balance now = balance(simulation.snapshot(), scene);
  return now.kinetic + now.strain;
}

Shape tilted_block(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  Chain corners;
  for (const auto& [x, y] :
       {std::pair(-4.0, -2.5), std::pair(4.0, -2.5), std::pair(4.0, 2.5), std::pair(-4.0, 2.5)})
    corners.push_back({dp * (x * std::cos(angle) - y * std::sin(angle)),
                       dp * (x * std::sin(angle) + y * std::cos(angle) + 4.8), 0});
  return Polygon({corners});
}

void check_energy_stays(const Scene& scene) {
  Settings settings = with_method("oenog");
  settings.constants["damping"] = 0;
  const auto simulation = make_simulation(scene, settings);
  const double start = total_energy(*simulation, scene);
  bool met = false;
  for (int k = 1; k <= 100; ++k) {
    simulation->advance_to(8e-5 * k);
    met = met || simulation->snapshot().contact_energy > 0;
    CHECK(std::abs(total_energy(*simulation, scene) / start - 1) < 0.01);
  }
  CHECK(met);
}

/// Forces must balance and be −∂E/∂x within `within` times the greatest force.
void check_slopes(Pressed<2>& bodies, double within) {
  for (int i = 0; i < bodies.s.size(); ++i)
    bodies.s.x[i] += 0.03 * dp *
                     V{shake({bodies.s.x[i][0], bodies.s.x[i][1], 0}, 7 * dp),
                       shake({bodies.s.x[i][1], bodies.s.x[i][0], 0}, 5 * dp)};
  const std::vector<V> force = bodies.forces();
  double greatest = 0, moment = 0;
  V sum{};
  for (int i = 0; i < bodies.s.size(); ++i) {
    sum += force[i];
    moment += bodies.s.x[i][0] * force[i][1] - bodies.s.x[i][1] * force[i][0];
    greatest = std::max(greatest, std::sqrt(dot(force[i], force[i])));
  }
  REQUIRE(greatest > 0.02 * modulus() * dp);
  CHECK(std::sqrt(dot(sum, sum)) < 1e-12 * greatest);
  CHECK(std::abs(moment) < 1e-12 * greatest * 0.01);
  int pushed = 0;
  for (int i = 0; i < bodies.s.size(); ++i) {
    if (force[i][0] == 0) continue;
    ++pushed;
    for (int k = 0; k < 2; ++k) {
      const double step = 1e-6 * dp, at = bodies.s.x[i][k];
      bodies.s.x[i][k] = at + step;
      const double more = bodies.energy();
      bodies.s.x[i][k] = at - step;
      const double less = bodies.energy();
      bodies.s.x[i][k] = at;
      CHECK(-(more - less) / (2 * step) == Approx(force[i][k]).scale(greatest).epsilon(within));
    }
  }
  CHECK(pushed > 10);
}

}  // namespace

TEST_SUITE("conservation") {
  TEST_CASE("surface contact: a disc and a narrow block that it hits stay mirror-symmetric") {
    for (const double half_width : {0.003, 0.004}) {
      CAPTURE(half_width);
      Scene scene =
          scene_of({Disc{{0, 0.00392, 0}, 0.00382}, Box{{-half_width, -0.006, 0}, {half_width, 0, 0}}});
      scene.bodies[0].velocity[1] = constant(-8);
      scene.bodies[1].clamped = [](const Point& x) { return x[1] < -0.004 ? 1.0 : 0.0; };
      for (const int body : {0, 1})
        scene.probes.push_back(
            make_probe(body == 0 ? "disc" : "block", Probe::Kind::mirror_asymmetry, {body, body}));
      const auto simulation = make_simulation(scene, with_method("oenog"));
      simulation->advance_to(1e-4);
      CHECK(simulation->snapshot().contact_energy > 0);
      simulation->advance_to(6e-4);
      for (const std::vector<double>& asymmetry : simulation->series().value)
        CHECK(*std::ranges::max_element(asymmetry) < 1e-15);
    }
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("surface contact: a tilted block that hits a flat one with a corner conserves the energy") {
    for (const double degrees : {5.0, 10.0, 20.0, 32.0, 38.0, 44.0}) {
      CAPTURE(degrees);
      Scene scene = scene_of({Box{{-0.012, -0.006, 0}, {0.012, 0, 0}}, tilted_block(degrees)});
      scene.bodies[1].velocity[1] = constant(-0.75);
      check_energy_stays(scene);
    }
  }

  TEST_CASE("surface contact: a tip that hits a node gains no energy") {
    constexpr double mm = 0.001;
    Scene scene = scene_of(
        {Box{{-3 * mm, 1.9 * mm, 0}, {3 * mm, 7.9 * mm, 0}}, Box{{-10 * mm, -4 * mm, 0}, {10 * mm, 0, 0}}});
    scene.spacing = mm;
    scene.materials = {{"rubber", 1000, 1e6, 0.3}};
    scene.bodies[0].on_boundary = scene.bodies[1].on_boundary = true;
    scene.bodies[0].rotation = Rotation{{0, 0, 1}, {0, 4.9 * mm, 0}, 45};
    scene.bodies[0].velocity[1] = constant(-0.3);
    scene.bodies[1].clamped = [](const Point& x) { return x[1] < -3 * mm ? 1.0 : 0.0; };
    const auto simulation = make_simulation(scene, with_method("oenog"));
    const double start = total_energy(*simulation, scene);
    double most = 0, touched = 0;
    while (simulation->time() < 0.005) {
      make_steps(*simulation, 1);
      most = std::max(most, total_energy(*simulation, scene) / start);
      touched = std::max(touched, simulation->snapshot().contact_energy / start);
    }
    CHECK(touched > 0.01);
    CHECK(most < 1.001);
  }

  TEST_CASE("surface contact: a ring whose inner face folds onto itself conserves the energy") {
    const Scene scene = small_collision();
    Settings settings = with_method("fe2");
    settings.cfl = 0.1;
    const auto simulation = make_simulation(scene, settings);
    const double start = total_energy(*simulation, scene);
    double folded = 0;
    while (simulation->time() < 1.2e-3) {
      make_steps(*simulation, 500);
      if (simulation->time() > 5e-4) folded = std::max(folded, simulation->snapshot().contact_energy);
    }
    CHECK(folded > 1e-3 * start);
    CHECK(total_energy(*simulation, scene) == Approx(start).epsilon(1e-3));
  }

  TEST_CASE("surface contact: a tilted block that rebounds from a wall conserves the energy") {
    for (const double degrees : {14.0, 20.0, 24.0, 28.0, 35.0}) {
      CAPTURE(degrees);
      Scene scene = scene_of({tilted_block(degrees)});
      scene.bodies[0].velocity[1] = constant(-0.75);
      scene.walls.push_back({"floor", {0, 0, 0}, {0, 1, 0}});
      check_energy_stays(scene);
    }
  }
}

TEST_SUITE("stability") {
  TEST_CASE(
      "surface contact: the greatest allowed stiffness shortens the steps and keeps the energy within 10 %") {
    Scene scene = two_blocks_that_meet();
    const double shorter = std::sqrt(100 / 2 / 1.5);
    for (const char* method : {"oenog", "tl", "pf"}) {
      CAPTURE(method);
      Settings settings = with_method(method);
      const auto run = [&](double stiffness) {
        settings.constants["contact_stiffness"] = stiffness;
        const auto simulation = make_simulation(scene, settings);
        const double start = total_energy(*simulation, scene);
        simulation->advance_to(4e-4);
        CHECK(std::abs(total_energy(*simulation, scene) / start - 1) < 0.1);
        return simulation->steps();
      };
      const long usual = run(2);
      CHECK(run(1) <= usual);
      const long stiff = run(100);
      CHECK(stiff > 2 * usual);
      CHECK(stiff < 1.2 * shorter * usual);
    }
  }
}

TEST_SUITE("term") {
  TEST_CASE("surface contact: the force is zero before faces meet and then the slope of the energy") {
    const double k = surface_stiffness(2e7, 3e7, 2, dp), depth = 0.2 * dp, step = 1e-6 * dp;
    CHECK(k == Approx(1.2e10));
    CHECK(surface_stiffness(2e7, 3e7, 2, dp) == surface_stiffness(3e7, 2e7, 2, dp));
    CHECK(surface_stiffness(2e7, 2e7, 2, dp) == 1e7 / dp);
    CHECK(surface_energy(-1e-9, dp, k) == 0);
    CHECK(surface_force(-1e-9, dp, k) == 0);
    CHECK((surface_energy(depth + step, dp, k) - surface_energy(depth - step, dp, k)) / (2 * step) ==
          Approx(surface_force(depth, dp, k)).epsilon(1e-8));
    CHECK(surface_energy(depth, dp, k) == Approx(0.25 * k * dp * depth * depth));
    CHECK(facing_share(-1) == 1);
    CHECK(facing_share(-0.5) == 1);
    CHECK(facing_share(-0.24) == 0);
    CHECK(facing_share(-0.375) == Approx(0.5));
    CHECK(facing_share(1) == 0);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("contact of faces: the force between two blocks is k times their area of overlap") {
    const double depth = 0.1 * dp, length = 6 * dp, k = modulus() / (2 * dp);
    Pressed<2> blocks(scene_of({Box{{-0.008, 0, 0}, {0, 0.006, 0}}, Box{{0, 0, 0}, {0.008, 0.006, 0}}}));
    blocks.shift(1, {-depth, 0});
    const V force = blocks.force_on(1);
    CHECK(force[0] == Approx(k * depth * length).epsilon(1e-9));
    CHECK(std::abs(force[1]) < 1e-9 * force[0]);
    CHECK(blocks.energy() == Approx(0.5 * k * depth * depth * length).epsilon(1e-9));
    CHECK(blocks.gap() == Approx(-depth).epsilon(1e-9));
  }

  TEST_CASE("contact of faces: a wall presses a body like the body's mirror image") {
    const double depth = 0.1 * dp, length = 6 * dp, k = modulus() / (2 * dp);
    Scene scene = scene_of({Box{{-0.008, 0, 0}, {0, 0.006, 0}}});
    scene.walls = {{"wall", {0, 0, 0}, {-1, 0, 0}}};
    Pressed<2> block(scene);
    CHECK(std::abs(block.force_on(0)[0]) < 1e-9 * k * depth * length);
    block.shift(0, {0.5 * depth, 0});
    CHECK(block.force_on(0)[0] == Approx(-k * depth * length).epsilon(1e-9));
    CHECK(block.energy() == Approx(0.25 * k * depth * depth * length).epsilon(1e-9));
  }

  TEST_CASE("contact of faces: discs at least 1 μm apart exert no force, and no force is attractive") {
    for (const double depth : {-0.3e-3, -1e-6, 1e-6, 0.1e-3, 0.3e-3}) {
      CAPTURE(depth);
      Pressed<2> discs = two_discs(depth);
      const V force = discs.force_on(1);
      const double sag = dp * dp / (8 * 0.006);
      CHECK(std::abs(discs.gap() + depth) < 2 * sag);
      const double away = force[0] * std::cos(0.7) + force[1] * std::sin(0.7);
      if (depth < 0)
        CHECK((force[0] == 0 && force[1] == 0 && discs.energy() == 0));
      else if (depth > 2 * sag)
        CHECK(away > 0.1 * modulus() * depth);
      CHECK(away >= 0);
      // a chord's normal is off by at most half its angle
      CHECK(std::abs(force[1] * std::cos(0.7) - force[0] * std::sin(0.7)) <= 1.05 * dp / (2 * 0.006) * away);
    }
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("contact of faces: forces are −∂E/∂x, and their sum and moment vanish") {
    Pressed<2> discs = two_discs(0.3 * dp);
    check_slopes(discs, 1e-5);
    for (const double past : {0.3, 0.8, 1.4}) {
      CAPTURE(past);
      Pressed<2> tips(scene_of({Box{{-0.008, 0, 0}, {0, 0.006, 0}}, Box{{0, 0.006, 0}, {0.008, 0.012, 0}}}));
      tips.shift(1, {-0.2 * dp, -past * dp});
      check_slopes(tips, 1e-5);
    }
  }

  TEST_CASE("contact of faces: an undamped oblique collision conserves both momenta and the energy") {
    Scene scene = small_collision();
    scene.contact = ContactLaw::surface;
    Settings settings = with_method("oenog");
    settings.constants["damping"] = 0;
    settings.cfl = 0.3;
    const auto simulation = make_simulation(scene, settings);
    const Balance before = balance(simulation->snapshot(), scene);
    const double energy = total_energy(*simulation, scene);
    double pressed = 0;
    for (int k = 0; k < 10; ++k) {
      make_steps(*simulation, 20);
      pressed = std::max(pressed, simulation->snapshot().contact_energy / energy);
      CHECK(total_energy(*simulation, scene) == Approx(energy).epsilon(2e-3));
    }
    CHECK(pressed > 0.01);
    const Balance after = balance(simulation->snapshot(), scene);
    for (int k = 0; k < 2; ++k)
      CHECK(std::abs(after.linear_momentum[k] - before.linear_momentum[k]) < 1e-13 * before.momentum_scale);
    CHECK(std::abs(after.angular_momentum[2] - before.angular_momentum[2]) < 1e-13 * before.angular_scale);
  }

  TEST_CASE("contact of faces: colliding tips create no energy") {
    Scene claps = scene_of({Box{{-0.01, -0.02, 0}, {0, 0.02, 0}}});
    claps.bodies[0].shapes.push_back(Box{{0, 0.01, 0}, {0.08, 0.02, 0}});
    claps.bodies[0].shapes.push_back(Box{{0, -0.02, 0}, {0.08, -0.01, 0}});
    claps.materials = {{"soft", /*ρ0*/ 1000, /*E*/ 1e6, /*ν*/ 0.4}};
    claps.spacing = 0.002;
    claps.bodies[0].velocity[1] = [](const Point& x) {
      return x[0] > 0 ? -std::copysign(1.0, x[1]) * std::pow(x[0] / 0.08, 2) : 0.0;
    };
    for (const double damping : {0.0, 0.01}) {
      CAPTURE(damping);
      Settings settings = with_method("oenog");
      settings.constants["damping"] = damping;
      const auto simulation = make_simulation(claps, settings);
      const double start = total_energy(*simulation, claps);
      double greatest = start;
      for (int k = 1; k <= 40; ++k) {
        simulation->advance_to(0.5e-3 * k);
        greatest = std::max(greatest, total_energy(*simulation, claps));
      }
      CHECK(greatest < 1.002 * start);
    }
  }

  TEST_CASE("contact of faces: the gap of two tips is measured where they touch") {
    const double half = 0.008;
    Scene scene =
        scene_of({Box{{-half, 0.0078, 0}, {half, 0.0238, 0}}, Box{{-half, -0.0238, 0}, {half, -0.0078, 0}}});
    scene.probes = {make_probe("gap", Probe::Kind::gap)};
    scene.probes[0].bodies = {0, 1};
    for (const int b : {0, 1}) {
      Body& body = scene.bodies[b];
      body.rotation = Rotation{{0, 0, 1}, {0, b == 0 ? 0.0158 : -0.0158, 0}, 45};
      body.velocity[1] = [b](const Point&) { return b == 0 ? -5.0 : 5.0; };
    }
    const auto simulation = make_simulation(scene, with_method("oenog"));
    simulation->advance_to(0.003);
    const std::vector<double>& gap = simulation->series().value[0];
    CHECK(*std::ranges::min_element(gap) < 0);
    CHECK(*std::ranges::min_element(gap) > -dp);  // faces that are turned away from each other are ignored
  }

  TEST_CASE("contact of faces: a flat body does not push a round one sideways where node meets node") {
    const double r = 0.02, depth = 0.1 * dp;
    Pressed<2> bodies(scene_of(
        {Disc{{0, -r, 0}, r, RoundLayout::spaced}, Box{{-0.03, -depth, 0}, {0.03, 0.006 - depth, 0}}}));
    const std::vector<V> force = bodies.forces();
    V on_disc{};
    for (int i = 0; i < bodies.s.size(); ++i)
      if (bodies.s.body[i] == 0) on_disc += force[i];
    REQUIRE(on_disc[1] < -0.01 * modulus() * dp);
    CHECK(std::abs(on_disc[0]) < 1e-9 * -on_disc[1]);
  }

  TEST_CASE("contact of faces: mirrored bodies stay mirrored to the last bit") {
    Scene scene = colliding_rings(0.14, 0.002);
    scene.contact = ContactLaw::surface;
    const auto simulation = make_simulation(scene, with_method("oenog"));
    simulation->advance_to(0.006);
    const Snapshot& now = simulation->snapshot();
    const std::size_t half = now.size() / 2;
    for (std::size_t i = 0; i < half; ++i) {
      CHECK(now.x[2 * i] == -now.x[2 * (i + half)]);
      CHECK(now.x[2 * i + 1] == now.x[2 * (i + half) + 1]);
    }
  }
}

TEST_SUITE("failure") {
  TEST_CASE("contact: closing arms of oenog, tl and pf-jst do not pass through each other under any law") {
    Scene scene = closing_arms(2, dp, 0.008, arm, 0.15);
    for (const char* method : {"oenog", "tl", "pf-jst"}) {
      for (const ContactLaw law : find_method(method)->contact_laws) {
        CAPTURE(std::string(method));
        CAPTURE(std::string(name(law)));
        scene.contact = law;
        const auto simulation = make_simulation(scene, with_method(method));
        const Balance before = balance(simulation->snapshot(), scene);
        double pressed = 0, most = -1;
        for (int k = 1; k <= 30; ++k) {
          simulation->advance_to(0.0001 * k);
          pressed = std::max(pressed, simulation->snapshot().contact_energy / before.kinetic);
          most = std::max(most, penetration(simulation->snapshot(), 2, dp, arm));
        }
        CHECK(most < 0);
        CHECK(most > -dp);  // the arms meet
        if (law != ContactLaw::impulse) CHECK(pressed > 0.001);
        const Balance after = balance(simulation->snapshot(), scene);
        CHECK(std::abs(after.linear_momentum[0] - before.linear_momentum[0]) < 1e-12 * before.momentum_scale);
        CHECK(std::abs(after.angular_momentum[2] - before.angular_momentum[2]) <
              1e-12 * before.angular_scale);
      }
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE(
      "contact of faces: the middle of a pressed or bent body has no self-contact, a rolled-up body has") {
    constexpr double inside = 0.008;
    CHECK(touching_after<2>([](const V& x) { return V{x[0], 0.5 * x[1]}; }, dp, inside) == 0);
    CHECK(touching_after<2>([](const V& x) { return bent(x, 0.012); }, dp, inside) == 0);
    CHECK(touching_after<2>([](const V& x) { return bent(x, -0.003); }, dp, 0) > 0);
  }

  TEST_CASE("contact of faces: a body too thin to have faces is refused") {
    const Scene scene = scene_of({Box{{0, 0, 0}, {0.02, dp, 0}}, Box{{0, 0.002, 0}, {0.02, 0.008, 0}}});
    try {
      make_simulation(scene, with_method("oenog"));
      FAIL("nothing was thrown");
    } catch (const SceneError& error) {
      CHECK(error.key == "body.body 0");
      for (const char* part : {"'surface'", "'body 0'", "too thin", "smaller spacing"})
        CHECK(std::string(error.what()).find(part) != std::string::npos);
    }
  }

  TEST_CASE("contact of faces: parts one particle thick are refused, straight, bent or jittered") {
    const Box block{{0, -0.02, 0}, {0.02, -0.01, 0}};
    const auto refusal = [&](const std::vector<Shape>& shapes, double jitter = 0) -> std::string {
      Scene scene = scene_of({shapes.front(), block});
      scene.bodies[0].shapes = shapes;
      scene.jitter.share = jitter;
      try {
        make_simulation(scene, with_method("oenog"));
      } catch (const SceneError& error) {
        CHECK(error.key == "body.body 0");
        return error.what();
      }
      return "";
    };
    const auto fin = [](int particles) -> std::vector<Shape> {
      return {Box{{0, 0, 0}, {0.01, 0.01, 0}}, Box{{0.01, 0.005, 0}, {0.01 + particles * dp, 0.006, 0}}};
    };
    const auto wedge = [](double slope) -> std::vector<Shape> {
      return {Polygon({Chain{{0, 0, 0}, {0.04, -0.04 * slope, 0}, {0.04, 0.04 * slope, 0}}})};
    };
    const std::string too_thin = "'body 0' is too thin to have all of them";
    for (const double jitter : {0.0, 0.1}) {
      CAPTURE(jitter);
      CHECK(refusal(fin(10), jitter).find(too_thin) != std::string::npos);
      CHECK(refusal({Ring{{0, 0, 0}, 0.005, 0.006}}, jitter).find(too_thin) != std::string::npos);
      CHECK(refusal({Ring{{0, 0, 0}, 0.005, 0.007}}, jitter).empty());
      CHECK(refusal({Box{{0, 0, 0}, {0.02, 0.002, 0}}}, jitter).empty());
      CHECK(refusal(fin(3), jitter).empty());
      CHECK(refusal(wedge(0.3), jitter).empty());
    }
    CHECK(refusal(wedge(0.1)).empty());
    CHECK(refusal(wedge(0.03)).find(too_thin) != std::string::npos);
  }
}

}  // namespace of_this_file
