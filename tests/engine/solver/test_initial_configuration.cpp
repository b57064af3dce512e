#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.004;

Scene scene_of(int dim, const std::vector<Shape>& shapes, double jitter = 0) {
  Scene scene;
  scene.dim = dim;
  scene.spacing = dp;
  scene.jitter.share = jitter;
  scene.materials = {ring_rubber()};
  scene.bodies.resize(1);
  scene.bodies[0].name = "thing";
  scene.bodies[0].shapes = shapes;
  return scene;
}

Scene ring_of(double inner, int rows) { return scene_of(2, {Ring{{0, 0, 0}, inner, inner + rows * dp}}); }

/// Block with a row of particles.
Scene fin_of(int particles, double jitter) {
  return scene_of(
      2,
      {Box{{0, 0, 0}, {10 * dp, 10 * dp, 0}}, Box{{10 * dp, 5 * dp, 0}, {(10 + particles) * dp, 6 * dp, 0}}},
      jitter);
}

/// The error message, or "".
std::string refusal(const Scene& scene, const std::string& method, double h = 0) {
  Settings settings = with_method(method);
  if (h > 0) settings.constants["h"] = h;
  try {
    make_simulation(scene, settings);
  } catch (const SceneError& error) {
    CHECK(error.key == "body.thing");
    return error.what();
  }
  return "";
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("initial configuration: bent and jittered parts one particle thick are refused") {
    const Scene plate = scene_of(3, {Box{{0, 0, 0}, {20 * dp, 20 * dp, dp}}}, 0.3);
    for (const char* method : {"icb", "tl", "tl-hg", "tl-enog", "pf", "pf-jst", "pfj-jst", "pfhj-jst"}) {
      CAPTURE(std::string(method));
      for (const double inner : {4, 5, 10, 50}) {
        CAPTURE(inner);
        const std::string error = refusal(ring_of(inner * dp, 1), method);
        for (const char* part : {"'thing'", "too thin", method, "smaller spacing"})
          CHECK(error.find(part) != std::string::npos);
      }
      CHECK(refusal(plate, method).find("too thin") != std::string::npos);
      CHECK(refusal(fin_of(10, 0.1), method).find("too thin") != std::string::npos);
    }
  }

  TEST_CASE("initial configuration: parts two particles thick and tips are accepted") {
    const Box strip{{0, 0, 0}, {50 * dp, 2 * dp, 0}}, rod{{0, 0, 0}, {20 * dp, 2 * dp, 2 * dp}};
    for (const char* method : {"icb", "tl", "pf"}) {
      CAPTURE(std::string(method));
      CHECK(refusal(ring_of(dp, 2), method).empty());
      for (const double h : {0.8, 1.3, 3.0}) {
        CAPTURE(h);
        CHECK(refusal(scene_of(2, {strip}, 0.1), method, h).empty());
        CHECK(refusal(scene_of(3, {rod}, 0.1), method, h).empty());
      }
      CHECK(refusal(scene_of(2, {strip}, 0.3), method).empty());
      CHECK(refusal(fin_of(1, 0.1), method).empty());
    }
    CHECK(refusal(fin_of(2, 0.1), "icb").empty());
  }
}

}  // namespace of_this_file
