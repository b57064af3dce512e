#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr int steps = 150;
constexpr double round_off = 1e-13;  // relative change over all steps

Scene solid_collision() {
  const double dp = 0.001, c0 = ring_rubber().sound_speed();
  Scene scene;
  scene.name = "solid-collision";
  scene.dim = 3;
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  Body block, ball;
  block.name = "block";
  block.shapes = {Box{{-0.0051, -0.003, -0.002}, {-0.0001, 0.003, 0.002}}};
  block.velocity[0] = [=](const Point& x) { return c0 * (0.1 + 0.02 * shake(x, 5 * dp)); };
  block.velocity[1] = [=](const Point& x) { return c0 * (10 * x[2] + 0.02 * shake(x, 7 * dp)); };
  block.velocity[2] = [=](const Point& x) { return -10 * c0 * x[1]; };
  ball.name = "ball";
  ball.shapes = {Disc{{0.0038, 0.0013, -0.0007}, 0.003}};
  ball.velocity[0] = [=](const Point& x) { return c0 * (-0.12 + 0.02 * shake(x, 6 * dp)); };
  ball.velocity[1] = constant(0.03 * c0);
  ball.velocity[2] = constant(-0.02 * c0);
  scene.bodies = {block, ball};
  return scene;
}

double change(const Point& before, const Point& after) {
  return std::hypot(after[0] - before[0], after[1] - before[1], after[2] - before[2]);
}

double momentum_along_x(const Snapshot& now) {
  double sum = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now.body[i] == 0) sum += now.m[i] * now.v[3 * i];
  return sum;
}

bool claims(const MethodInfo& method, const char* what) {
  return method.conserves.find(what) != std::string_view::npos;
}

}  // namespace

TEST_SUITE("conservation") {
  TEST_CASE("in 3D a collision conserves to round-off each momentum that the method claims to conserve") {
    const Scene scene = solid_collision();
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const auto simulation = make_simulation(scene, with_method(std::string(method.name)));
      const Snapshot start = simulation->snapshot();
      const Balance before = balance(start, scene);
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(before.linear_momentum[k]) > 1e-3 * before.momentum_scale);
        CHECK(std::abs(before.angular_momentum[k]) > 0.01 * before.angular_scale);
      }
      make_steps(*simulation, steps);
      const Balance after = balance(simulation->snapshot(), scene);
      CHECK(std::abs(momentum_along_x(simulation->snapshot()) / momentum_along_x(start) - 1) > 0.1);
      const double push = change(before.linear_momentum, after.linear_momentum) / before.momentum_scale;
      if (claims(method, "linear momentum"))
        CHECK(push < round_off);
      else
        CHECK(push > 1e-6);
      const double turn = change(before.angular_momentum, after.angular_momentum) / before.angular_scale;
      if (claims(method, "angular momentum"))
        CHECK(turn < round_off);
      else
        CHECK(turn > 1e-4);
      // shear forces of enog do not rotate, ccb damps no tension, pf damps no zigzags
      if (method.name != "enog" && method.name != "ccb" && method.name != "pf")
        CHECK(after.kinetic + after.strain < 1.001 * before.kinetic);
    }
  }

  TEST_CASE("in 3D an unstrained body in free flight keeps every velocity and stays unstressed") {
    Scene scene = solid_collision();
    scene.bodies.pop_back();
    const double speed = 0.1 * scene.materials[0].sound_speed();
    scene.bodies[0].velocity = {constant(speed), constant(-0.5 * speed), constant(0.3 * speed)};
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const Snapshot now = state_after(steps, scene, with_method(std::string(method.name)));
      double change_of_v = 0, stress = 0;
      for (std::size_t i = 0; i < now.size(); ++i) {
        const Point v = now.velocity(i);
        change_of_v = std::max(change_of_v, change({speed, -0.5 * speed, 0.3 * speed}, v));
        const StressTensor t = now.stress(i);
        for (const double each : {t.xx, t.yy, t.zz, t.xy, t.xz, t.yz})
          stress = std::max(stress, std::abs(each));
      }
      CHECK(now.x[0] - now.x0[0] > scene.spacing);
      // strains computed from positions have the round-off of x, relative to the spacing
      const double bound = keeps_neighbors(method) ? 100 * round_off : round_off;
      CHECK(change_of_v < bound * speed);
      CHECK(stress < bound * scene.materials[0].youngs_modulus);
    }
  }
}

}  // namespace of_this_file
