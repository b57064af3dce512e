#include <cmath>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "engine/diagnostics/lines.hpp"
#include "engine/diagnostics/measures.hpp"
#include "engine/error.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

SampleLine line_across_plate(std::vector<double> times) {
  SampleLine line;
  line.name = "across";
  line.field = "velocity_y";
  line.from = {-0.01, 0.0037, 0};
  line.to = {0.01, -0.01, 0};
  line.points = 7;
  line.times = std::move(times);
  return line;
}

std::string error_key(const Scene& scene) {
  const auto simulation = make_simulation(scene, with_method("oenog"));
  try {
    LineRecorder(scene, simulation->snapshot(), simulation->support());
  } catch (const SceneError& error) {
    return error.key;
  }
  return "none";
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("lines: a linear field is exact up to the faces and corners") {
    Scene scene = rotating_plate(0.01);
    scene.lines = {line_across_plate({0})};
    const double omega = scene.bodies[0].velocity[1]({1, 0, 0});
    Settings short_support = with_method("tl-small-strain");  // a corner has one particle within the support
    short_support.constants["h"] = 0.5;
    for (const Settings& settings : {with_method("oenog"), with_method("tl"), short_support}) {
      CAPTURE(settings.method);
      const auto simulation = make_simulation(scene, settings);
      LineRecorder lines(scene, simulation->snapshot(), simulation->support());
      CHECK(lines.next() == 0);
      lines.sample(simulation->snapshot());
      CHECK(lines.next() == std::numeric_limits<double>::infinity());
      REQUIRE(lines.samples().at(0).size() == 1);
      for (int k = 0; k < 7; ++k)
        CHECK(lines.samples()[0][0].value[k] ==
              Approx(omega * line_point(scene.lines[0], k)[0]).scale(omega * 0.01).epsilon(1e-12));
    }
    CHECK(line_point(scene.lines[0], 6) == Point{0.01, -0.01, 0});
    CHECK(line_point(scene.lines[0], 3)[1] == relative((0.0037 - 0.01) / 2));
  }

  TEST_CASE("lines: a stress is extrapolated linearly into the clamp, as by a probe") {
    Scene scene = rotating_plate(0.01);
    scene.bodies[0].velocity = {};
    scene.bodies[0].clamped = [](const Point& x) { return x[1] > 0.008 ? 1.0 : 0.0; };
    scene.bodies[0].displacement[1] = [](const Point& x) { return 1e-3 * (x[1] - 20 * x[1] * x[1]); };
    SampleLine line;
    line.name = "down";
    line.field = "stress_yy";
    line.from = {0.001, -0.005, 0}, line.to = {0.001, 0.0082, 0};
    line.points = 10;
    line.times = {0};
    scene.lines = {line};
    for (int k = 0; k < line.points; ++k) {
      scene.probes.push_back(make_probe("stress", Probe::Kind::stress));
      scene.probes.back().at = line_point(line, k);
      scene.probes.back().part = StressPart::yy;
    }
    for (const char* method : {"oenog", "tl"}) {
      CAPTURE(method);
      const auto simulation = make_simulation(scene, with_method(method));
      LineRecorder lines(scene, simulation->snapshot(), simulation->support());
      lines.sample(simulation->snapshot());
      const std::vector<double>& on_line = lines.samples().at(0).at(0).value;
      for (std::size_t k = 0; k < on_line.size(); ++k)
        CHECK(on_line[k] == relative(simulation->series().value[k][0], 1e-12));
      CHECK(on_line[8] - on_line[7] == relative(on_line[5] - on_line[4], 0.1));
    }
  }

  TEST_CASE("lines: a sample is interpolated at its time between two steps, and alters no step") {
    Scene scene = rotating_plate(0.01);
    const auto plain = make_simulation(scene, with_method("oenog"));
    make_steps(*plain, 20);
    const double late = plain->time() * 0.73, later = plain->time();
    scene.lines = {line_across_plate({0, late, late, later}), line_across_plate({later})};
    scene.lines[1].name = "again";
    const auto simulation = make_simulation(scene, with_method("oenog"));
    LineRecorder lines(scene, simulation->snapshot(), simulation->support());
    for (lines.sample(simulation->snapshot()); std::isfinite(lines.next());)
      lines.sample(state_at(lines.next(), *simulation));
    CHECK(simulation->steps() == plain->steps());
    CHECK(simulation->snapshot().x == plain->snapshot().x);
    CHECK(simulation->snapshot().v == plain->snapshot().v);
    const std::vector<LineSample>& samples = lines.samples().at(0);
    REQUIRE(samples.size() == 4);
    CHECK(samples[0].step == 0);
    CHECK(samples[1].time == late);
    CHECK(samples[1].step > 0);
    CHECK(samples[1].step < samples[3].step);
    CHECK(samples[2].step == samples[1].step);
    CHECK(samples[3].step == 20);
    CHECK(samples[3].time == later);
    LineRecorder at_step(scene, make_simulation(scene, with_method("oenog"))->snapshot(),
                         simulation->support());
    at_step.sample(plain->snapshot());
    CHECK(at_step.samples().at(0).at(0).value == samples[3].value);
    CHECK(lines.samples().at(1).at(0).step == 20);
  }

  TEST_CASE("lines and probes: a point outside the body is a scene error, as is an unknown field of a line") {
    Scene scene = rotating_plate(0.01);
    scene.lines = {line_across_plate({0})};
    CHECK(error_key(scene) == "none");
    scene.lines[0].to = {0.02, 0, 0};
    CHECK(error_key(scene) == "line.across");
    scene.lines[0] = line_across_plate({0});
    scene.lines[0].field = "colour";
    CHECK(error_key(scene) == "line.across.field");
    scene.lines.clear();
    scene.probes = {make_probe("far", Probe::Kind::position)};
    scene.probes[0].at = {0.02, 0, 0};
    try {
      make_simulation(scene, with_method("oenog"));
      FAIL("no error for a point outside the body");
    } catch (const SceneError& error) {
      CHECK(error.key == "probe.far");
    }
  }

  TEST_CASE("lines: points in space stay fixed while the body moves, and give no value outside the body") {
    Scene scene = rotating_plate(0.01);
    scene.bodies[0].velocity[0] = constant(300);
    scene.bodies[0].velocity[1] = [](const Point& X) { return 5 * X[0]; };
    scene.lines = {line_across_plate({0, 1e-7}), line_across_plate({0, 1e-7})};
    scene.lines[0].in_space = true;
    scene.lines[1].name = "material";
    Settings settings = with_method("oenog");
    settings.step = 1e-7;
    const auto simulation = make_simulation(scene, settings);
    LineRecorder lines(scene, simulation->snapshot(), simulation->support());
    lines.sample(simulation->snapshot());
    simulation->advance_to(1e-7);
    lines.sample(simulation->snapshot());
    for (int k = 0; k < 7; ++k) {
      const double start = lines.samples()[0][0].value[k], later = lines.samples()[0][1].value[k];
      CHECK(start == Approx(5 * line_point(scene.lines[0], k)[0]).scale(1e-3).epsilon(1e-9));
      CHECK(later - start == relative(-5 * 3e-5, 0.05));
      CHECK(std::abs(lines.samples()[1][1].value[k] - start) < 0.05 * 5 * 3e-5);
    }
    scene.lines[0].to = {10, 0, 0};
    LineRecorder far(scene, simulation->snapshot(), simulation->support());
    far.sample(simulation->snapshot());
    CHECK(std::isnan(far.samples()[0][0].value[6]));
    CHECK(std::isfinite(far.samples()[0][0].value[0]));
  }

  TEST_CASE(
      "line_error: the error against a table over distance is relative to the table's RMS at the points") {
    Scene scene;
    scene.lines = {line_across_plate({1})};
    scene.lines[0].from = {1, 2, 0};
    scene.lines[0].to = {4, 6, 0};
    scene.lines[0].points = 3;
    Measure of_line;
    of_line.name = "number";
    of_line.kind = "line_error";
    of_line.line = "across";
    scene.measures = {of_line};
    scene.references["neo_hookean"].table["number"] = {{0, 4, 6}, {{1, 9, -7}}};
    const auto value = [&](std::vector<double> shown) {
      return measure(scene, {}, "neo_hookean", {{{1, 3, std::move(shown)}}}).at(0).value;
    };
    CHECK(*value({1, 6, 1}) == 0);
    CHECK(*value({1, 9, 5}) == relative(5 / std::sqrt(38)));
    CHECK_FALSE(value({1, std::nan(""), 5}));
    scene.measures[0].kind = "line_rmse";
    CHECK(*value({1, 9, 5}) == relative(5 / std::sqrt(3)));
    CHECK_FALSE(measure(scene, {}, "neo_hookean", {{}}).at(0).value);
  }

  TEST_CASE("line_rmse: the distance along a line in 3D is Euclidean") {
    Scene scene;
    scene.lines = {line_across_plate({1})};
    scene.lines[0].from = {1, 2, 3};
    scene.lines[0].to = {4, 6, 15};
    scene.lines[0].points = 2;
    Measure of_line;
    of_line.name = "number";
    of_line.kind = "line_rmse";
    of_line.line = "across";
    scene.measures = {of_line};
    scene.references["neo_hookean"].table["number"] = {{0, 26}, {{0, 26}}};
    CHECK(*measure(scene, {}, "neo_hookean", {{{1, 3, {0, 13}}}}).at(0).value == 0);
  }

  TEST_CASE("line_rmse: all points and times count, with the reference at the sample's time") {
    Scene scene;
    scene.lines = {line_across_plate({1, 2})};
    scene.lines[0].points = 2;
    Measure measure_of_line;
    measure_of_line.name = "number";
    measure_of_line.kind = "line_rmse";
    measure_of_line.line = "across";
    scene.measures = {measure_of_line};
    scene.references["neo_hookean"] = {
        "exact", {}, {}, {{"number", {[](const Point& x, double t) { return x[0] + t; }}}}};
    const auto result = [&](std::vector<LineSample> samples) {
      return measure(scene, {}, "neo_hookean", {std::move(samples)}).at(0);
    };
    const std::vector<LineSample> samples = {{1.25, 3, {1.24 + 1, 1.26}}, {2.5, 6, {2.49, 2.51 - 3}}};
    CHECK(*result(samples).value == relative(std::sqrt((1 + 9) / 4.0)));
    CHECK(*result(samples).reference == 0);
    CHECK(*result(samples).error == *result(samples).value);
    CHECK_FALSE(result({samples[0]}).value);
    CHECK_FALSE(measure(scene, {}, "neo_hookean").at(0).value);
    CHECK_FALSE(measure(scene, {}, "2d_deviator", {samples}).at(0).reference);
    scene.references["neo_hookean"].solution["number"] = {
        [](const Point& x, double t) { return 1e-6 * (x[0] + t); }};
    std::vector<LineSample> rescaled = samples;
    for (LineSample& sample : rescaled)
      for (double& value : sample.value) value *= 1e-6;
    CHECK(*result(rescaled).value == relative(1e-6 * std::sqrt(2.5)));
  }
}

}  // namespace of_this_file
