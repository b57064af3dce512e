#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.001;

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

/// [Lee2016] §8.2: standing wave, a quarter wavelength per side; rollers at the faces through the origin, no
/// tangential motion on the others.
Scene swinging_cube(int dim, int n) {
  const double side = n * dp, amplitude = 1e-5 * side, wave = std::numbers::pi / (2 * side);
  Scene scene = block(side);
  scene.dim = dim;
  Body& body = scene.bodies[0];
  body.shapes = {Box{{0, 0, 0}, {side, side, dim == 3 ? side : 0}}};
  body.on_boundary = true;
  const auto near = [](double x, double face) { return std::abs(x - face) < 0.1 * dp; };
  const auto axes = static_cast<std::size_t>(dim);
  for (std::size_t k = 0; k < axes; ++k) {
    body.guided[k] = [=](const Point& x) {
      bool clamped = near(x[k], 0);
      for (std::size_t l = 0; l < axes; ++l) clamped |= l != k && near(x[l], side);
      return clamped ? 1.0 : 0.0;
    };
    body.displacement[k] = [=](const Point& x) {
      double u = amplitude;
      for (std::size_t l = 0; l < axes; ++l) u *= l == k ? std::sin(wave * x[l]) : std::cos(wave * x[l]);
      return u;
    };
  }
  return scene;
}

/// RMS difference from u(X, 0) cos ωt, ω = √dim/2 π/L c_p, divided by the amplitude.
double swinging_error(int dim, int n, const std::string& method) {
  const Scene scene = swinging_cube(dim, n);
  const Material& rubber = scene.materials[0];
  const double c_p = std::sqrt((rubber.bulk_modulus() + 4.0 / 3 * rubber.shear_modulus()) / rubber.density);
  const double omega = std::sqrt(dim) / 2 * std::numbers::pi / (n * dp) * c_p;
  Settings settings = with_method(method);
  settings.cfl = 0.2;
  const auto simulation = make_simulation(scene, settings);
  simulation->advance_to(std::numbers::pi / 4 / omega);
  const Snapshot& now = simulation->snapshot();
  double sum = 0, mass = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Point X = now.initial(i), start = displaced(scene.bodies[0], X), x = now.position(i);
    mass += dim * now.m[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const double off = x[k] - X[k] - (start[k] - X[k]) * std::cos(omega * now.time);
      sum += now.m[i] * off * off;
    }
  }
  return std::sqrt(sum / mass) / (1e-5 * n * dp);
}

/// RMS errors over volume and four times, relative to the greatest velocity and pressure.
struct SwingingErrors {
  double velocity = 0, stress = 0;
};
SwingingErrors errors_over_period(int n, const Settings& given) {
  const Scene scene = swinging_cube(3, n);
  const Material& rubber = scene.materials[0];
  const double K = rubber.bulk_modulus(), G = rubber.shear_modulus();
  const double wave = std::numbers::pi / (2 * n * dp), U = 1e-5 * n * dp;
  const double omega = std::sqrt(3.0) * wave * std::sqrt((K + 4.0 / 3 * G) / rubber.density);
  const auto simulation = make_simulation(scene, given);
  double v2 = 0, stress2 = 0, volume = 0;
  for (const int eighths : {1, 3, 5, 7}) {
    simulation->advance_to(eighths * std::numbers::pi / 4 / omega);
    const Snapshot& now = simulation->snapshot();
    const double c = std::cos(omega * now.time), s = std::sin(omega * now.time);
    for (std::size_t i = 0; i < now.size(); ++i) {
      const Point X = now.initial(i), start = displaced(scene.bodies[0], X), v = now.velocity(i);
      const auto product = [&](int a, int b) {
        double f = 1;
        for (int k = 0; k < 3; ++k) f *= k == a || k == b ? std::sin(wave * X[k]) : std::cos(wave * X[k]);
        return f;
      };
      const double V = now.m[i] / rubber.density, shear = -2 * G * U * wave * c;
      const auto [xx, yy, zz, xy, xz, yz] = now.deviator(i);
      volume += V;
      for (std::size_t k = 0; k < 3; ++k) v2 += V * std::pow(v[k] + omega * s * (start[k] - X[k]), 2);
      stress2 +=
          V * (3 * std::pow(now.p[i] + 3 * K * U * wave * c * product(-1, -1), 2) + xx * xx + yy * yy +
               zz * zz + 2 * std::pow(xy - shear * product(0, 1), 2) +
               2 * std::pow(xz - shear * product(0, 2), 2) + 2 * std::pow(yz - shear * product(1, 2), 2));
    }
  }
  return {std::sqrt(v2 / volume) / (U * omega), std::sqrt(stress2 / volume) / (3 * K * U * wave)};
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("displacement: a method without a reference configuration refuses a displacement with a reason") {
    Scene scene = block(0.006);
    scene.bodies[0].displacement[0] = [](const Point& x) { return 0.01 * x[0]; };
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      if (method.keeps_neighbors) {
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

TEST_SUITE("unit") {
  TEST_CASE("displacement: a body displaced into another is refused, whatever their undisplaced positions") {
    Scene scene = block(0.02);
    scene.bodies.push_back(scene.bodies[0]);
    Body& small = scene.bodies[1];
    small.name = "small";
    small.shapes = {Box{{0.05, 0, 0}, {0.054, 0.004, 0}}};
    const auto starts = [&](double dx, double dy) {
      small.displacement = {constant(dx), constant(dy), {}};
      try {
        make_simulation(scene, with_method("tl"));
        return true;
      } catch (const SceneError& error) {
        CHECK(std::string(error.what()).find("bodies 'small' and 'block' overlap at") != std::string::npos);
        return false;
      }
    };
    CHECK_FALSE(starts(-0.0425, 0.0085));
    CHECK(starts(-0.03, 0.0085));
    const double c = std::cos(0.7), s = std::sin(0.7);
    scene.bodies[0].displacement[0] = [=](const Point& x) { return 1.2 * c * x[0] - s * x[1] - x[0]; };
    scene.bodies[0].displacement[1] = [=](const Point& x) { return 1.2 * s * x[0] + c * x[1] - x[1]; };
    CHECK_FALSE(starts(-0.0501, 0.016));
    CHECK(starts(-0.035, 0.001));  // inside the undisplaced layout of the other body
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("displacement: a body that starts stretched is stressed, and one that starts rotated is not") {
    Scene stretched = block(0.008), turned = block(0.008);
    stretched.bodies[0].displacement[0] = [](const Point& x) { return 0.1 * x[0]; };
    const double c = std::cos(0.7), s = std::sin(0.7);
    turned.bodies[0].displacement[0] = [=](const Point& x) { return c * x[0] - s * x[1] - x[0]; };
    turned.bodies[0].displacement[1] = [=](const Point& x) { return s * x[0] + c * x[1] - x[1]; };
    const double K = ring_rubber().bulk_modulus(), G = ring_rubber().shear_modulus();
    for (const char* method : {"tl", "pf-jst", "pfj-jst", "oenog"}) {
      CAPTURE(method);
      const Snapshot pulled = at_start(stretched, method), spun = at_start(turned, method);
      const double s_yy = G * std::pow(1.1, -5.0 / 3) * (1 - (1.21 + 2) / 3);
      for (std::size_t i = 0; i < pulled.size(); ++i) {
        CHECK(pulled.deviator(i).yy == Approx(s_yy).epsilon(1e-6));
        CHECK(pulled.p[i] == Approx(pulled.p[0]).epsilon(1e-9));
        CHECK(std::abs(spun.p[i]) < 1e-9 * K);
        CHECK(std::abs(spun.deviator(i).xy) < 1e-9 * G);
      }
      CHECK(pulled.p[0] < -0.05 * K);
    }
  }

  TEST_CASE("displacement: a clamped body that starts displaced with its clamp stays at rest") {
    Scene scene = block(0.01);
    scene.bodies[0].clamped = [](const Point& x) { return x[0] < 0.004 ? 1.0 : 0.0; };
    scene.bodies[0].displacement = {constant(0.3), constant(-0.2), {}};
    for (const char* method : {"tl", "pfj-jst", "oenog"}) {
      CAPTURE(method);
      const Snapshot now = state_after(30, scene, with_method(method));
      for (const double v : now.v) CHECK(std::abs(v) < 1e-9);
    }
  }
}

TEST_SUITE("convergence") {
  TEST_CASE("a square and a cube with guides and particles on the faces converge to the exact vibration") {
    const auto check = [](int dim, const char* method, double bound, double ratio) {
      CAPTURE(dim);
      CAPTURE(std::string(method));
      const double coarse = swinging_error(dim, 8, method), fine = swinging_error(dim, 16, method);
      CHECK(coarse < bound);
      CHECK(fine < coarse / ratio);
    };
    check(2, "oenog", 0.02, 2.5);
    check(3, "oenog", 0.008, 3.5);
    check(2, "tl", 0.03, 3);
    check(2, "pf-jst", 0.03, 3.5);
    check(3, "tl", 0.03, 2.5);
  }

  TEST_CASE(
      "swinging cube: errors of velocity and stress are of second order, with and without boundary projection") {
    const auto check = [](const char* method, double projection) {
      CAPTURE(std::string(method));
      CAPTURE(projection);
      Settings settings = with_method(method);
      settings.constants["boundary_projection"] = projection;
      const SwingingErrors coarse = errors_over_period(8, settings), fine = errors_over_period(16, settings);
      CHECK(coarse.velocity < 0.03);
      CHECK(coarse.stress < 0.06);
      CHECK(std::log2(coarse.velocity / fine.velocity) > 1.8);
      CHECK(std::log2(coarse.stress / fine.stress) > 1.8);
    };
    check("pf-jst", 0);
    check("pf-jst", 1);
    check("pfj-jst", 0);
    check("pfhj-jst", 0);
  }
}

}  // namespace of_this_file
