#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.001;  // m

Scene block(double side) {
  Scene scene;
  scene.name = "block";
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  scene.bodies.resize(1);
  scene.bodies[0].name = "block";
  scene.bodies[0].shapes = {Box{{0, 0, 0}, {side, side, 0}}};
  return scene;
}

Snapshot at_start(const Scene& scene, std::string_view method) {
  return make_simulation(scene, with_method(std::string(method)))->snapshot();
}

/// A square of `n` × `n` cells that swings as one half wave: rollers on the faces x = 0 and y = 0, nothing moves
/// along the other two. [Lee2016] §8.2 in plane strain, with particles on the faces.
Scene swinging_square(int n) {
  const double side = n * dp, amplitude = 1e-5 * side, k = std::numbers::pi / (2 * side);
  Scene scene = block(side);
  Body& body = scene.bodies[0];
  body.on_boundary = true;
  const auto near = [=](double x, double face) { return std::abs(x - face) < 0.1 * dp; };
  body.guided[0] = [=](const Point& x) { return near(x[0], 0) || near(x[1], side) ? 1.0 : 0.0; };
  body.guided[1] = [=](const Point& x) { return near(x[1], 0) || near(x[0], side) ? 1.0 : 0.0; };
  body.displacement[0] = [=](const Point& x) { return amplitude * std::sin(k * x[0]) * std::cos(k * x[1]); };
  body.displacement[1] = [=](const Point& x) { return amplitude * std::cos(k * x[0]) * std::sin(k * x[1]); };
  return scene;
}

/// Greatest difference from the exact displacement u(X, 0) cos ωt over its amplitude, after an eighth of a period.
double swinging_error(int n, const std::string& method) {
  const Scene scene = swinging_square(n);
  const Material& material = scene.materials[0];
  const double c_p =
      std::sqrt((material.bulk_modulus() + 4.0 / 3 * material.shear_modulus()) / material.density);
  const double omega = std::numbers::sqrt2 * std::numbers::pi / (2 * n * dp) * c_p;
  Settings settings = with_method(method);
  settings.cfl = 0.2;
  const auto simulation = make_simulation(scene, settings);
  simulation->advance_to(std::numbers::pi / 4 / omega);
  const Snapshot& now = simulation->snapshot();
  double greatest = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Point X = now.initial(i), start = displaced(scene.bodies[0], X), x = now.position(i);
    for (std::size_t k = 0; k < 2; ++k)
      greatest = std::max(greatest, std::abs(x[k] - X[k] - (start[k] - X[k]) * std::cos(omega * now.time)));
  }
  return greatest / (1e-5 * n * dp);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("displacement: a method without a reference configuration refuses it and says why") {
    Scene scene = block(0.006);
    scene.bodies[0].displacement[0] = [](const Point& x) { return 0.01 * x[0]; };
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      if (taut::keeps_neighbors(method.formulation)) {
        const Snapshot start = at_start(scene, method.name);
        for (std::size_t i = 0; i < start.size(); ++i)
          CHECK(start.x[2 * i] == relative(1.01 * start.x0[2 * i]));
        continue;
      }
      try {
        at_start(scene, method.name);
        FAIL_CHECK("no error");
      } catch (const SceneError& error) {
        CHECK(error.key == "body.block.displacement");
        CHECK(std::string(error.what()).find("has no reference configuration") != std::string::npos);
      }
    }
  }
}

TEST_SUITE("analytic") {
  TEST_CASE(
      "displacement: a body that starts stretched is stressed by that, and one that starts turned is not") {
    Scene stretched = block(0.008), turned = block(0.008);
    stretched.bodies[0].displacement[0] = [](const Point& x) { return 0.1 * x[0]; };
    const double c = std::cos(0.7), s = std::sin(0.7);
    turned.bodies[0].displacement[0] = [=](const Point& x) { return c * x[0] - s * x[1] - x[0]; };
    turned.bodies[0].displacement[1] = [=](const Point& x) { return s * x[0] + c * x[1] - x[1]; };
    const double K = ring_rubber().bulk_modulus(), G = ring_rubber().shear_modulus();
    for (const char* method : {"tl", "pf-jst", "pfj-jst", "oenog"}) {
      CAPTURE(method);
      const Snapshot pulled = at_start(stretched, method), spun = at_start(turned, method);
      // s_yy = G J^(−5/3) (1 − (λ² + 2)/3)
      const double s_yy = G * std::pow(1.1, -5.0 / 3) * (1 - (1.21 + 2) / 3);
      for (std::size_t i = 0; i < pulled.size(); ++i) {
        CHECK(pulled.deviator(i).yy == doctest::Approx(s_yy).epsilon(1e-6));
        CHECK(pulled.p[i] == doctest::Approx(pulled.p[0]).epsilon(1e-9));
        CHECK(std::abs(spun.p[i]) < 1e-9 * K);
        CHECK(std::abs(spun.deviator(i).xy) < 1e-9 * G);
      }
      CHECK(pulled.p[0] < -0.05 * K);
    }
  }

  TEST_CASE("displacement: a clamped body that starts displaced with its clamp stays at rest") {
    Scene scene = block(0.01);
    scene.bodies[0].held = [](const Point& x) { return x[0] < 0.004 ? 1.0 : 0.0; };
    scene.bodies[0].displacement = {constant(0.3), constant(-0.2), {}};
    for (const char* method : {"tl", "pfj-jst", "oenog"}) {
      CAPTURE(method);
      const Snapshot now = state_after(30, scene, with_method(method));
      for (const double v : now.v) CHECK(std::abs(v) < 1e-9);
    }
  }
}

TEST_SUITE("convergence") {
  TEST_CASE("guides, displacement, particles on the faces: a square swings as it must, to second order") {
    for (const char* method : {"tl", "pf-jst"}) {
      CAPTURE(method);
      const double coarse = swinging_error(8, method), fine = swinging_error(16, method);
      MESSAGE(coarse, " ", fine);
      CHECK(coarse < 0.02);
      CHECK(fine < coarse / 3);
    }
  }
}
