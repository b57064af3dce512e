#include <algorithm>
#include <string>

#include <doctest/doctest.h>

#include "engine/diagnostics/critical_step.hpp"
#include "engine/diagnostics/step_limits.hpp"
#include "engine/error.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr CriticalStepSearch quick{.steps = 100, .tolerance = 2e-3};

/// `pull`: speed of the left and of the right side, in sound speeds.
Scene square(double pull = 0) {
  const double half = 0.5;
  Scene scene;
  scene.name = "square";
  scene.spacing = 0.05;
  scene.until = 10;
  scene.materials = {{"elastic", /*ρ0*/ 1000, /*E*/ 1000, /*ν*/ 0.3}};
  Body plate;
  plate.name = "plate";
  plate.shapes = {Box{{-half, -half, 0}, {half, half, 0}}};
  const double rate = pull * scene.materials[0].sound_speed() / half;
  plate.velocity[0] = [=](const Point& x) { return rate * x[0]; };
  scene.bodies = {plate};
  return scene;
}

Settings with_h(double h, double normalised) {
  Settings settings = with_method("tl-small-strain");
  settings.constants = {{"h", h}, {"normalised", normalised}};
  return settings;
}

double critical(const Scene& scene, const Settings& settings) {
  const CriticalStep found = find_critical_step(scene, settings, quick);
  REQUIRE(found.stable);
  REQUIRE(found.unstable);
  CHECK(*found.unstable > *found.stable);
  CHECK(*found.unstable < 1.002 * *found.stable / (1 - 2e-3));
  return *found.stable;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE(
      "critical step: with four neighbours the search finds the sharp limit, above the sufficient limit") {
    for (const double normalised : {0.0, 1.0}) {
      CAPTURE(normalised);
      const Scene scene = square();
      const Settings settings = with_h(0.45, normalised);
      const auto limits = step_limits(scene, settings);
      REQUIRE(limits.size() == 2);
      const double found = critical(scene, settings);
      CHECK(found == Approx(limits[0].step).epsilon(0.03));
      CHECK(found > limits[1].step);
      CHECK(limits[0].step / limits[1].step == Approx(1.134).epsilon(1e-3));  // √((3 − 4ν)/(2 (1 − ν)))
    }
  }

  TEST_CASE(
      "critical step: with more neighbours and uncorrected gradients the search finds the sharp limit") {
    for (const double h : {0.7, 1.0, 1.3}) {
      CAPTURE(h);
      const Settings settings = with_h(h, 0);
      CHECK(critical(square(), settings) == Approx(step_limits(square(), settings)[0].step).epsilon(0.03));
    }
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("critical step in 3D: the search finds the sharp limit of the cubic lattice") {
    Scene cube = square();
    cube.dim = 3;
    cube.spacing = 0.1;
    cube.bodies[0].shapes = {Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}};
    for (const double h : {0.45, 1.0}) {
      CAPTURE(h);
      const auto limits = step_limits(cube, with_h(h, 0));
      REQUIRE(limits.size() == 1);  // the sufficient limit of [Zhang2020] is for 2D
      CHECK(critical(cube, with_h(h, 0)) == Approx(limits[0].step).epsilon(0.05));
    }
    // with six neighbours the wave number is greatest, √3/dp, for the wave vector (1, 1, 1) π/(2 dp)
    Settings six = with_method("tl");
    six.constants["h"] = 0.6;
    const Material& m = cube.materials[0];
    const double c_p = std::sqrt((m.bulk_modulus() + 4 * m.shear_modulus() / 3) / m.density);
    CHECK(step_limits(cube, six)[0].step == Approx(2 * cube.spacing / (c_p * std::sqrt(3.0))));
  }
}

TEST_SUITE("convergence") {
  TEST_CASE(
      "critical step: it is smallest for medium h, and normalising raises it for short h and lowers it for long h") {
    const auto step = [](double h, double normalised) { return critical(square(), with_h(h, normalised)); };
    const double uncorrected[] = {step(0.55, 0), step(0.75, 0), step(1.3, 0)};
    const double normalised[] = {step(0.55, 1), step(0.75, 1), step(1.3, 1)};
    for (const auto& s : {uncorrected, normalised}) {  // [Zhang2020] Fig. 16
      CHECK(s[1] < 0.95 * s[0]);
      CHECK(s[1] < 0.95 * s[2]);
    }
    CHECK(normalised[0] > 1.1 * uncorrected[0]);
    CHECK(normalised[2] < 0.9 * uncorrected[2]);
  }
}

TEST_SUITE("failure") {
  TEST_CASE("critical step: tension reduces the step of ccb, but not the step of tl-small-strain") {
    const Settings linear = with_h(1, 1);  // [Zhang2020] Fig. 15
    const double at_rest = critical(square(), linear);
    for (const double pull : {0.05, 0.2})
      CHECK(critical(square(pull), linear) == Approx(at_rest).epsilon(0.005));
    const Settings current = with_method("ccb");
    const double ccb = critical(square(), current);
    CHECK(critical(square(0.05), current) < 0.95 * ccb);
    CHECK(critical(square(0.2), current) < 0.67 * ccb);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("critical step: every method accepts a fixed step") {
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      Settings settings = with_method(std::string(method.name));
      settings.step = 1e-3;
      CHECK(state_after(3, square(0.1), settings).time == Approx(3e-3));
    }
  }

  TEST_CASE("critical step: the search can be stopped, and may find no stable or no unstable step") {
    int reports = 0;
    const CriticalStep stopped =
        find_critical_step(square(), with_h(1, 1), quick, [&](const CriticalStep&) { return ++reports < 3; });
    CHECK(stopped.interrupted);
    CHECK(!stopped.stable);
    Settings settings = with_h(1, 1);
    settings.cfl = 1000;  // even 1/16 of this step is too long
    const CriticalStep none = find_critical_step(square(), settings, quick);
    CHECK(!none.stable);
    CHECK(none.unstable);
    settings.cfl = 1e-5;
    settings.constants["h"] = 1;
    const CriticalStep all = find_critical_step(square(), settings, {.steps = 1, .tolerance = 1e-2});
    CHECK(all.stable);
    CHECK(!all.unstable);
  }

  TEST_CASE("critical step: only tl, icb and tl-small-strain have limits to compare with") {
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const std::size_t limits = step_limits(square(), with_method(std::string(method.name))).size();
      const bool leap_frog = method.name == "tl" || method.name == "icb";
      CHECK(limits == (method.name == "tl-small-strain" ? 2 : leap_frog ? 1 : 0));
    }
  }
}

}  // namespace of_this_file
