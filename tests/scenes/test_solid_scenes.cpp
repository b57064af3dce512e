#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/curve.hpp"
#include "engine/diagnostics/indicators.hpp"
#include "engine/diagnostics/measures.hpp"
#include "engine/judge/verdict.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/simulation.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::cli;

namespace {

struct Run {
  std::map<std::string, MeasureResult> measure;
  Verdict verdict = Verdict::stable;
  Readings last{};
  int pieces = 0;

  double error(const std::string& name) const {
    const MeasureResult& result = measure.at(name);
    INFO(name);
    REQUIRE(result.value);
    REQUIRE(result.error);
    return *result.error;
  }
};

Run run(const std::string& name, const std::string& method, std::vector<Setting> settings) {
  settings.push_back({"method", method});
  SceneFile file = read_scene(find_scene(name), settings);
  file.settings.threads = 1;
  const auto simulation = make_simulation(file.scene, file.settings);
  Judge judge(file.scene, *simulation);
  IndicatorGauge gauge(file.scene, simulation->snapshot());
  Run run;
  constexpr int looks = 20;
  for (int k = 1; k <= looks; ++k) {
    simulation->advance_to(file.scene.until * k / looks);
    const Snapshot& now = simulation->snapshot();
    run.last = gauge(now);
    judge.observe(now, balance(now, file.scene), run.last);
  }
  run.verdict = judge.verdict();
  run.pieces = judge.pieces();
  const std::string_view law = material_law(*find_method(method), file.settings, 3);
  for (const MeasureResult& result : measure(file.scene, simulation->series(), law))
    run.measure[result.name] = result;
  return run;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("oscillating plate in 3D: oenog with three layers has the first peak of finite elements") {
    const Run plate = run("oscillating-plate-3d", "oenog", {{"side", "0.2"}, {"until", "0.0074"}});
    CHECK(plate.error("first_peak") < 0.01);
    CHECK(plate.verdict == Verdict::stable);
  }

  TEST_CASE("oscillating plate in 3D: tl and enog are too soft with three layers, and have no zigzags") {
    // period and peak of finite elements
    const double time = 0.003, period = 0.01367, peak = 2.16e-3;
    const double should = peak * std::sin(2 * std::numbers::pi * time / period);
    for (const auto& [method, least, most] : {std::tuple{"tl", 1.03, 1.08}, {"enog", 1.06, 1.1}}) {
      const auto said = std::string(method);
      CAPTURE(said);
      SceneFile file = read_scene(find_scene("oscillating-plate-3d"),
                                  {{"method", method}, {"side", "0.2"}, {"until", exact(time)}});
      file.settings.threads = 1;
      const auto simulation = make_simulation(file.scene, file.settings);
      simulation->advance_to(time);
      const Series& series = simulation->series();
      const double there = value_at({series.time, series.value.at(0)}, time);
      CHECK(there > least * should);
      CHECK(there < most * should);
      CHECK(IndicatorGauge(file.scene, simulation->snapshot())(simulation->snapshot())[0].share() < 0.001);
    }
  }

  TEST_CASE("colliding balls: oenog flattens and rebounds like finite elements, with exact mirror symmetry") {
    const Run balls = run("colliding-balls", "oenog", {{"spacing", "0.0025"}});
    CHECK(balls.error("rebound_ratio") < 0.003);
    CHECK(balls.error("least_pole_distance") < 0.003);
    CHECK(balls.error("least_diameter") < 0.007);
    CHECK(balls.error("touch_time") < 0.015);
    CHECK(balls.error("separation_time") < 0.02);
    CHECK(*balls.measure.at("diameter_rmse").value < 0.017);
    CHECK(*balls.measure.at("speed_rmse").value < 0.005);
    CHECK(*balls.measure.at("mirror_asymmetry").value == 0);
    CHECK(balls.verdict == Verdict::stable);
    CHECK(balls.pieces == 2);
  }

  TEST_CASE("ball and plate in 3D: oenog bends the plate like finite elements, symmetrically") {
    const Run ball = run("ball-plate-3d", "oenog", {{"spacing", "0.0066667"}, {"until", "0.012"}});
    CHECK(ball.error("deflection") < 0.04);
    CHECK(ball.error("ball_lowest") < 0.04);
    CHECK(ball.error("rebound_ratio") < 0.04);
    CHECK(*ball.measure.at("mirror_asymmetry_x").value < 1e-12);
    CHECK(*ball.measure.at("mirror_asymmetry_z").value < 1e-12);
    CHECK(ball.verdict == Verdict::stable);
  }
}

}  // namespace of_this_file
