#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "cli/scene/shipped.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/indicators.hpp"
#include "engine/diagnostics/measures.hpp"
#include "engine/diagnostics/verdict.hpp"
#include "engine/families/catalogue.hpp"
#include "engine/simulation.hpp"

using namespace taut;
using namespace taut::cli;

/// What [Lee2016] says of its §8.6 to 8.9, with its numbers of particles.
namespace {

struct Run {
  std::map<std::string, MeasureResult> measure;
  Verdict verdict = Verdict::stable;
  double zigzag = 0, checkerboard = 0;  // greatest, of the places and of the pressure
  double gain = 0;                      // greatest energy above what was given, over what was given
  Snapshot end;

  double value(const std::string& name) const {
    INFO(name);
    REQUIRE(measure.at(name).value);
    return *measure.at(name).value;
  }
  double error(const std::string& name) const {
    INFO(name);
    REQUIRE(measure.at(name).error);
    return *measure.at(name).error;
  }
};

Run run(const std::string& name, const std::string& method, std::vector<Setting> settings = {}) {
  settings.push_back({"method", method});
  SceneFile file = read_scene(find_scene(name), settings);
  file.settings.threads = 1;
  const auto simulation = make_simulation(file.scene, file.settings);
  Judge judge(file.scene, simulation->snapshot(), simulation->support());
  IndicatorGauge gauge(file.scene, simulation->snapshot());
  std::array<IndicatorRecord, indicators.size()> record;
  const Balance start = balance(simulation->snapshot(), file.scene);
  Run run;
  constexpr int looks = 40;
  for (int k = 1; k <= looks && judge.verdict() != Verdict::diverged; ++k) {
    simulation->advance_to(file.scene.until * k / looks);
    const Snapshot& now = simulation->snapshot();
    const Balance sums = balance(now, file.scene);
    const Readings readings = gauge(now);
    for (std::size_t i = 0; i < record.size(); ++i) record[i].take(readings[i], now.time);
    judge.observe(now, sums, readings);
    const double given = start.kinetic + start.strain + sums.work;
    run.gain = std::max(run.gain, (sums.kinetic + sums.strain) / given - 1);
  }
  run.verdict = judge.verdict();
  run.zigzag = record[0].greatest(), run.checkerboard = record[1].greatest();
  run.end = simulation->snapshot();
  const std::string_view law = material_law(*find_method(method), file.settings, 3);
  for (const MeasureResult& result : measure(file.scene, simulation->series(), law, {}, &run.end))
    run.measure[result.name] = result;
  return run;
}

const Setting smoothed_J{"method.eps_J4", "0.125"};

/// Root of the mean square distance of two runs' particles, m.
double apart(const Run& a, const Run& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.end.x.size(); ++k) sum += std::pow(a.end.x[k] - b.end.x[k], 2);
  return std::sqrt(sum / static_cast<double>(a.end.size()));
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("bending column in 3D: the JST methods and oenog swing as finite elements do") {
    for (const std::string method : {"pf-jst", "pfj-jst", "oenog"}) {
      CAPTURE(method);
      const Run column = run("bending-column-3d", method);
      CHECK(column.error("first_peak") < 0.03);
      CHECK(column.error("peak_time") < 0.02);
      // the place at 1.5 s, over how far it is from the one at the start
      const double off = std::hypot(column.value("top_x_1500ms") + 2.689, column.value("top_y_1500ms") + 0.759);
      CHECK(off < 0.05 * std::hypot(2.689, 0.759));
      CHECK(column.verdict == Verdict::stable);
      CHECK(column.gain < 1e-3);
    }
  }

  TEST_CASE("twisting column: pf-jst and oenog twist as finite elements do, the finer the nearer, about the axis") {
    double before = 1;
    for (const auto& [spacing, most] : {std::pair{"0.25", 0.1}, {"0.1666667", 0.03}}) {
      CAPTURE(spacing);
      const Run column = run("twisting-column", "pf-jst", {{"spacing", spacing}});
      CHECK(column.error("twist_100ms") < most);
      CHECK(column.error("twist_250ms") < most);
      CHECK(column.value("twist_rmse") < before);
      before = column.value("twist_rmse");
      CHECK(column.value("axis_x") < 1e-10);
      CHECK(column.value("axis_z") < 1e-10);
      CHECK(column.verdict == Verdict::stable);
    }
    const Run column = run("twisting-column", "oenog");
    CHECK(column.error("twist_100ms") < 0.015);
    CHECK(column.error("twist_250ms") < 0.015);
    CHECK(column.value("axis_x") < 1e-10);
    CHECK(column.value("axis_z") < 1e-10);
    CHECK(column.verdict == Verdict::stable);
  }
}

TEST_SUITE("failure") {
  // §8.6, Fig. 16
  TEST_CASE("punch: at ν = 0.499 the pressure of tl and pf-jst checkers, that of the methods with J does not") {
    const Run smooth = run("punch", "pfj-jst", {smoothed_J});
    CHECK(smooth.checkerboard < 0.06);
    for (const auto& [method, times] : {std::pair{"tl", 4.0}, {"pf", 4.0}, {"pf-jst", 2.0}}) {
      CAPTURE(method);
      CHECK(run("punch", method).checkerboard > times * smooth.checkerboard);
    }
    for (const std::string method : {"pf-jst", "pfj-jst", "pfhj-jst"}) {
      CAPTURE(method);
      const Run block = run("punch", method, {{"method.eps_J4", "0.125"}});
      CHECK(std::abs(block.value("volume_change")) < 0.02);
      CHECK(block.gain < 1e-6);
    }
  }
}
