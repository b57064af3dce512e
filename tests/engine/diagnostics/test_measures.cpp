#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include <doctest/doctest.h>

#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/diagnostics/measures.hpp"
#include "engine/error.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

TEST_SUITE("unit") {
  TEST_CASE("rmse: series and table are compared over their common time up to `until` only") {
    Scene scene = scene_of("rmse");
    scene.references["neo_hookean"] = {"a table", {}, {{"number", {{0.5, 0.8, 2.5}, {{1.5, 1.8, 3.5}}}}}};
    scene.until = 2;
    const Series series{{0, 0.7, 1.1, 2.2}, {{2, 2.7, 3.1, 4.2}}};
    const MeasureResult constant = result(scene, series);
    expect(constant.value, 1);
    expect(constant.reference, 0);
    expect(constant.error, 1);
    CHECK(constant.reference_name == "a table");
    // √(∫ (t − 1)² dt / 1.5)
    const Series steeper{{0, 0.7, 1.1, 2.2}, {{0, 1.4, 2.2, 4.4}}};
    expect(result(scene, steeper).value, std::sqrt((1 + 0.125) / 3 / 1.5));
    for (const double scale : {4.0, -4.0}) {
      scene.measures[0].scale = scale;
      expect(result(scene, series).value, 0.25);
      expect(result(scene, series).error, 0.25);
    }
  }

  TEST_CASE("rmse: the mean is over time, not over steps") {
    Scene scene = scene_of("rmse");
    scene.references["neo_hookean"] = {"zero", {}, {{"number", {{0, 1}, {{0, 0}}}}}};
    const auto wave = [](double t) { return std::sin(2 * pi * t) * (t < 0.5 ? 1 : 0); };
    std::vector<double> times = unequal_times(0.5, 1e-4);
    for (int k = 1; times.back() < 1; ++k) times.push_back(times.back() + 1e-2);
    expect(result(scene, sampled(times, wave)).value, 0.5, 1e-4);
  }

  TEST_CASE("rmse: a table finer than the steps is used at its own times") {
    Scene scene = scene_of("rmse");
    scene.references["neo_hookean"] = {"a tent", {}, {{"number", {{0, 0.5, 1}, {{0, 1, 0}}}}}};
    expect(result(scene, Series{{0, 1}, {{0, 0}}}).value, std::sqrt(1 / 3.0));
  }

  TEST_CASE(
      "rmse: the measure needs a table that begins before the run ends, and a run up to `until` or the last row") {
    Scene scene = scene_of("rmse");
    const Series series{{0, 0.5, 0.95}, {{1, 1, 1}}};
    CHECK_FALSE(result(scene, series).value);
    CHECK_FALSE(result(scene, series).reference);
    CHECK(result(scene, series).why == "there is no reference to compare with");
    scene.references["neo_hookean"] = {"of another measure", {{"other", 1}}};
    CHECK(result(scene, series).why ==
          "the reference 'of another measure' of this law has no value for this measure");
    scene.references["neo_hookean"] = {"zero", {}, {{"number", {{0, 9}, {{0, 0}}}}}};
    CHECK_FALSE(result(scene, series).value);
    CHECK(result(scene, series).reference == 0.0);
    CHECK_FALSE(result(scene, series).error);
    scene.until = 0.95;
    expect(result(scene, series).value, 1);
    scene.until = 1;
    scene.references["neo_hookean"].table["number"] = {{0, 0.9}, {{0, 0}}};
    expect(result(scene, series).value, 1);
    scene.until = 0.95;
    scene.references["neo_hookean"].table["number"] = {{3, 4}, {{0, 0}}};
    CHECK_FALSE(result(scene, series).value);
  }

  TEST_CASE("rmse: an exact solution is compared between the steps too, also if it is curved or jumps") {
    Scene scene = scene_of("rmse");
    // √(∫ t⁴ dt) over 0 … 1
    scene.references["neo_hookean"] = {
        "exact", {}, {}, {{"number", {[](const Point&, double t) { return 2 * t - t * t; }}}}};
    const Series series{{0, 0.3, 0.9, 1.5}, {{0, 0.6, 1.8, 3}}};
    expect(result(scene, series).value, std::sqrt(1 / 5.0));
    CHECK(result(scene, series).reference == 0.0);
    scene.measures[0].scale = 2;
    expect(result(scene, series).value, std::sqrt(1 / 5.0) / 2);
    scene.measures[0].scale = 1;
    scene.until = 2;
    CHECK_FALSE(result(scene, series).value);
    scene.until = 1;
    scene.references["neo_hookean"].solution["number"] = {[](const Point&, double t) { return t > 0.7; }};
    std::vector<double> times;
    for (int k = 0; k <= 1000; ++k) times.push_back(k * 1e-3);
    expect(result(scene, sampled(times, [](double) { return 0.0; })).value, std::sqrt(0.3), 1e-3);
  }

  TEST_CASE("path_error: the error is the greatest distance at the rows of a table") {
    Scene scene = scene_of("path_error");
    scene.measures[0].probes = {"y", "gap"};
    scene.measures[0].scale = 10;
    scene.references["neo_hookean"] = {
        "table", {}, {{"number", {{0, 0.5, 1, 1.5}, {{0, 0, 0, 9}, {0, 0, 0, 9}}}}}, {}};
    const Series series{{0, 0.5, 0.75, 1.2}, {{0, 3, 90, 5}, {0, 4, 90, 12}}};
    expect(result(scene, series).value, std::hypot(90 - 85 * 0.25 / 0.45, 90 - 78 * 0.25 / 0.45) / 10);
    CHECK(result(scene, series).reference == 0.0);
    scene.until = 0.75;
    expect(result(scene, series).value, 0.5);
    expect(result(scene, series).error, 0.5);
    scene.measures[0].scale = -10;
    expect(result(scene, series).value, 0.5);
    scene.until = 1.25;
    CHECK_FALSE(result(scene, series).value);
    scene.references.clear();
    CHECK_FALSE(result(scene, series).value);
    CHECK_FALSE(result(scene, series).reference);
  }

  TEST_CASE("path_error: an exact path is compared at the steps") {
    Scene scene = scene_of("path_error");
    scene.measures[0].probes = {"y", "gap"};
    scene.references["neo_hookean"] = {"exact",
                                       {},
                                       {},
                                       {{"number",
                                         {[](const Point&, double t) { return std::cos(t); },
                                          [](const Point&, double t) { return std::sin(t); }}}}};
    Series series{unequal_times(1, 1e-2), {{}, {}}};
    for (const double t : series.time) {
      const double angle = t + 0.1 * std::exp(-100 * (t - 0.5) * (t - 0.5));
      series.value[0].push_back(std::cos(angle));
      series.value[1].push_back(std::sin(angle));
    }
    expect(result(scene, series).value, 2 * std::sin(0.05), 1e-2);
  }

  TEST_CASE("turn: whole turns count with their sign up to `until`") {
    Scene scene = scene_of("turn");
    scene.measures[0].probes = {"y", "gap"};
    scene.until = 3;
    for (const double omega : {9.0, -9.0}) {
      Series series{unequal_times(3.1, 1e-3), {{}, {}}};
      for (const double t : series.time) {
        series.value[0].push_back(0.7 * std::cos(1 + omega * t));
        series.value[1].push_back(0.7 * std::sin(1 + omega * t));
      }
      scene.references["neo_hookean"] = {
          "table", {}, {{"number", {{0, 1, 2, 3}, {{1, 0, -1, 0}, {0, 1, 0, -1}}}}}, {}};
      const MeasureResult found = result(scene, series);
      expect(found.value, 3 * omega, 1e-6);
      expect(found.reference, 1.5 * pi);
      expect(found.error, std::abs(3 * omega / (1.5 * pi) - 1), 1e-6);
      scene.references["neo_hookean"] = {"exact",
                                         {},
                                         {},
                                         {{"number",
                                           {[](const Point&, double t) { return std::cos(4 * t); },
                                            [](const Point&, double t) { return std::sin(4 * t); }}}}};
      expect(result(scene, series).reference, 12, 1e-6);
      scene.until = 3.2;
      CHECK_FALSE(result(scene, series).value);
      scene.until = 3;
    }
  }

  TEST_CASE("turn: in 3D motion along the measure's axis does not count") {
    Scene scene = scene_of("turn");
    scene.probes.resize(3);
    scene.probes[2].name = "z";
    scene.measures[0].probes = {"y", "gap", "z"};
    scene.until = 3;
    const Point axis{2.0 / 3, -1.0 / 3, 2.0 / 3}, first{1 / std::sqrt(5.0), 2 / std::sqrt(5.0), 0},
        second{-4 / std::sqrt(45.0), 2 / std::sqrt(45.0), 5 / std::sqrt(45.0)};
    const auto place = [&](double angle, double along, std::size_t k) {
      return along * axis[k] + 0.7 * (std::cos(angle) * first[k] + std::sin(angle) * second[k]);
    };
    scene.measures[0].axis = axis;
    Series series{unequal_times(3.1, 1e-3), {{}, {}, {}}};
    for (const double t : series.time)
      for (std::size_t k = 0; k < 3; ++k) series.value[k].push_back(place(1 + 9 * t, 5 * std::sin(t), k));
    Reference& reference = scene.references["neo_hookean"];
    reference.name = "exact";
    for (std::size_t k = 0; k < 3; ++k)
      reference.solution["number"].emplace_back([=](const Point&, double t) { return place(-4 * t, t, k); });
    expect(result(scene, series).value, 27, 1e-6);
    expect(result(scene, series).reference, -12, 1e-6);
    reference.solution.clear();
    ReferenceTable& table = reference.table["number"];
    table.value.resize(3);
    for (int row = 0; row <= 3; ++row) {
      table.t.push_back(row);
      for (std::size_t k = 0; k < 3; ++k) table.value[k].push_back(place(row * pi / 2, 0, k));
    }
    expect(result(scene, series).reference, 1.5 * pi, 1e-9);
  }

  TEST_CASE(
      "minimum and maximum: both are taken over the steps, and absent if the series ends at its extreme") {
    expect(value("minimum", {0, 1, 2, 3}, {5, 2, 3, 7}), 2);
    expect(value("maximum", {0, 1, 2, 3}, {5, 2, 9, 7}), 9);
    CHECK_FALSE(value("minimum", {0, 1, 2}, {5, 4, 2}));
    CHECK_FALSE(value("maximum", {0, 1, 2}, {5, 4, 8}));
    CHECK_FALSE(value("minimum", {0, 1, 2}, {5, 5, 5}));
  }

  TEST_CASE("maximum: for a mirror asymmetry the maximum exists even if the series ends at it") {
    Scene scene = scene_of("maximum");
    scene.probes[0].kind = Probe::Kind::mirror_asymmetry;
    expect(result(scene, Series{{0, 1, 2}, {{0, 1e-9, 3e-9}}}).value, 3e-9);
  }

  TEST_CASE("first_below and last_below: crossings are interpolated linearly at the threshold") {
    Scene first = scene_of("first_below"), last = scene_of("last_below");
    first.measures[0].threshold = last.measures[0].threshold = 1;
    const Series contact{{0, 1, 3, 4, 5, 7, 8}, {{3, 2, 0, 2, 0, 4, 5}}};
    expect(result(first, contact).value, 2);
    expect(result(last, contact).value, 5.5);
    const Series apart{{0, 1}, {{3, 1.01}}};
    CHECK_FALSE(result(first, apart).value);
    CHECK_FALSE(result(last, apart).value);
    const Series stuck{{0, 1, 2}, {{3, 1, 1}}};
    expect(result(first, stuck).value, 1);
    CHECK_FALSE(result(last, stuck).value);
    CHECK_FALSE(result(last, Series{{0, 1, 2}, {{3, 0, 1}}}).value);
    const Series leaving{{0, 2}, {{0, 2}}};
    CHECK(result(first, leaving).value == 0.0);
    expect(result(last, leaving).value, 1);
  }

  TEST_CASE(
      "final_ratio: the last value is divided by the scale, with `free` only after bodies have touched and separated") {
    Scene scene = scene_of("final_ratio");
    scene.measures[0].scale = -4;
    const std::vector<double> t = {0, 1, 2}, speed = {4, 1, -3};
    expect(result(scene, Series{t, {speed, {1, 1, 1}}}).value, 0.75);
    scene.measures[0].free = "gap";
    expect(result(scene, Series{t, {speed, {1, -1, 1}}}).value, 0.75);
    CHECK_FALSE(result(scene, Series{t, {speed, {1, -1, 0}}}).value);
    CHECK_FALSE(result(scene, Series{t, {speed, {1, 0.1, 1}}}).value);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(result(scene, Series{t, {speed, {1, -1, nan}}}).why == "gap is not finite after 1 s");
    CHECK(result(scene, Series{t, {speed, {nan, -1, 1}}}).why == "the series is not finite at its start");
  }

  TEST_CASE(
      "value: series and solution are evaluated at `time`, and a series that ends earlier has no value") {
    Scene scene = scene_of("value");
    scene.until = 4;
    scene.measures[0].time = 1.5;
    expect(result(scene, Series{{0, 1, 2, 4}, {{0, 3, 4, 9}}}).value, 3.5);
    CHECK_FALSE(result(scene, Series{{0, 1, 1.4}, {{0, 3, 4}}}).value);
    scene.references["neo_hookean"].name = "exact";
    scene.references["neo_hookean"].solution["number"] = {[](const Point&, double t) { return -2 * t; }};
    expect(result(scene, Series{{0, 1, 2}, {{0, 3, 4}}}).reference, -3);
  }

  TEST_CASE("at_rest: the final value counts, and there is no value while the series still moves") {
    const auto damped = [](double rate) {
      return sampled(unequal_times(1, 1e-3), [=](double t) { return -3 * (1 - std::exp(-rate * t)); });
    };
    Scene scene = scene_of("at_rest");
    scene.until = damped(8).time.back();
    expect(result(scene, damped(8)).value, -3, 5e-4);  // moves by 4e-4 of its value in the last tenth
    CHECK_FALSE(result(scene, damped(6)).value);
    CHECK_FALSE(result(scene, Series{{0, 0.5, 0.9}, {{0, 1, 1}}}).value);
    expect(result(scene, Series{{0, 0.5, scene.until}, {{0, 1, 1}}}).value, 1);
    scene.references["neo_hookean"].name = "exact";
    scene.references["neo_hookean"].solution["number"] = {[](const Point&, double t) { return -2 * t; }};
    expect(result(scene, damped(8)).reference, -2 * scene.until);
  }

  TEST_CASE("measure: a reference of the same law gives a relative error, or an absolute one if it is 0") {
    Scene scene = scene_of("maximum");
    scene.references["neo_hookean"] = {"finite elements", {{"number", -8}}, {}, {}};
    scene.references["2d_deviator"] = {"other", {{"number", 0}, {"another", 1}}, {}, {}};
    const Series series{{0, 1, 2}, {{-9, -6, -7}}};
    const MeasureResult own = result(scene, series);
    CHECK(own.name == "number");
    CHECK(own.unit == "mm");
    expect(own.value, -6);
    expect(own.reference, -8);
    expect(own.error, 0.25);
    CHECK(own.reference_name == "finite elements");
    const MeasureResult other = measure(scene, series, "2d_deviator").at(0);
    expect(other.error, 6);
    CHECK(other.reference_name == "other");
    scene.references["silent"] = {"says nothing", {{"another", 1}}, {}, {}};
    CHECK_FALSE(measure(scene, series, "silent").at(0).reference);
    CHECK(measure(scene, series, "silent").at(0).reference_name.empty());
    const MeasureResult none = measure(scene, series, "rubber").at(0);
    expect(none.value, -6);
    CHECK_FALSE(none.reference);
    CHECK_FALSE(none.error);
    CHECK(none.reference_name.empty());
  }

  TEST_CASE("measure: every kind that uses probes is absent before the first step") {
    for (const MeasureKind& kind : measure_kinds()) {
      if (!kind.keys.front().starts_with("probe")) continue;
      CAPTURE(kind.name);
      Scene scene = scene_of(std::string(kind.name));
      if (kind.keys.front() == "probes") scene.measures[0].probes = {"y", "gap"};
      scene.measures[0].free = "gap";
      scene.references["neo_hookean"] = {"r", {{"number", 1}}, {{"number", {{0, 1}, {{0, 1}, {1, 0}}}}}, {}};
      const MeasureResult empty = result(scene, Series{{}, {{}, {}}});
      CHECK_FALSE(empty.value);
      CHECK_FALSE(empty.error);
      CHECK(empty.reference);
    }
  }

  TEST_CASE("measure: events before a run failed still count") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect(value("maximum", {0, 1, 2, 3, 4}, {0, 4, 2, nan, 9}), 4);
    expect(value("first_peak", {0, 1, 2, 3, 4}, {0, 2, 2, -1, nan}), 2.25);
    CHECK_FALSE(value("period", {0, 1, 2, 3, 4}, {0, 1, -1, nan, 1}));
  }

  TEST_CASE("measure: other units of time and length rescale the numbers") {
    const auto wave = [](double t) { return std::exp(-0.3 * t) * std::sin(2 * pi * t); };
    const Series series = sampled(unequal_times(3, 1e-2), wave);
    Series rescaled = series;
    for (double& t : rescaled.time) t *= 60;
    for (double& y : rescaled.value[0]) y *= 1e-9;
    const auto ratio = [&](const std::string& kind) { return *value(kind, rescaled) / *value(kind, series); };
    CHECK(ratio("period") == Approx(60));
    CHECK(ratio("first_peak") == Approx(1e-9).epsilon(1e-12));
    CHECK(ratio("minimum") == Approx(1e-9).epsilon(1e-12));
    CHECK(ratio("decay") == Approx(1));
  }

  TEST_CASE("measure: other units rescale the path error and leave the turn unchanged") {
    Scene scene = scene_of("path_error");
    scene.measures[0].probes = {"y", "gap"};
    scene.measures[0].scale = 2;
    Series series{unequal_times(1, 1e-2), {{}, {}}};
    ReferenceTable table{{0, 0.2, 0.4, 1}, {{1, 0.5, 0.1, -0.4}, {0, 0.6, 0.9, 0.8}}};
    for (const double t : series.time) {
      series.value[0].push_back(std::cos(2.1 * t));
      series.value[1].push_back(std::sin(2.1 * t));
    }
    const auto both = [&] {
      scene.references["neo_hookean"].table["number"] = table;
      scene.measures[0].kind = "path_error";
      const double error = *result(scene, series).value;
      scene.measures[0].kind = "turn";
      return std::pair(error, *result(scene, series).value);
    };
    const auto [error, angle] = both();
    CHECK(error > 0.01);
    for (std::vector<double>* times : {&series.time, &table.t})
      for (double& t : *times) t *= 60;
    scene.until *= 60;
    for (std::vector<std::vector<double>>* columns : {&series.value, &table.value})
      for (std::vector<double>& column : *columns)
        for (double& y : column) y *= 1e-3;
    const auto [error_mm, angle_same] = both();
    CHECK(error_mm == Approx(1e-3 * error).epsilon(1e-9));  // `scale` stays 2
    CHECK(angle_same == Approx(angle).epsilon(1e-9));
  }

  TEST_CASE("measure: an unknown kind is a scene error") {
    try {
      result(scene_of("perid"), Series{{0}, {{1}, {1}}});
      FAIL("no error");
    } catch (const SceneError& error) {
      CHECK(error.key == "measure.number.of");
      CHECK(std::string(error.what())
                .starts_with("there is no measure of kind 'perid'; name one of: period, "));
    }
  }

  TEST_CASE("measure: an unknown probe is a scene error that lists the probes") {
    for (const bool free : {false, true}) {
      Scene scene = scene_of("final_ratio");
      (free ? scene.measures[0].free : scene.measures[0].probes[0]) = "gpa";
      try {
        result(scene, Series{{0}, {{1}, {1}}});
        FAIL("no error");
      } catch (const SceneError& error) {
        CHECK(error.key == (free ? "measure.number.free" : "measure.number.probe"));
        CHECK(std::string(error.what()) == "there is no probe 'gpa'; name one of: y, gap");
      }
    }
  }
}

}  // namespace of_this_file
