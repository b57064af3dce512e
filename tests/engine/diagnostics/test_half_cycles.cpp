
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "engine/diagnostics/curve.hpp"
#include "tests/support/measured.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

TEST_SUITE("unit") {
  TEST_CASE("period: a sine of either sign with unequal steps gives its period") {
    const double T = 0.254;
    for (const double sign : {1.0, -1.0}) {
      const auto wave = [=](double t) { return sign * 0.1 * std::sin(2 * pi * t / T); };
      expect(value("period", sampled(unequal_times(0.5, 1e-4), wave)), T, 1e-6);
      CHECK_FALSE(value("period", sampled(unequal_times(0.99 * T, 1e-4), wave)));
    }
  }

  TEST_CASE("first_peak: round-off ahead of a wave is no half cycle") {
    const std::vector<double> times = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    const std::vector<double> wave = {0, 1e-18, -1e-17, 2e-13, -1e-12, 0, 1, 2, 1, -1};
    expect(value("first_peak", times, wave), 2);
    expect(value("peak_time", times, wave), 7);
    CHECK_FALSE(value("period", times, wave));
  }

  TEST_CASE("period: zeros are interpolated linearly between steps") {
    expect(value("period", {0, 1, 2, 4, 5}, {0, 3, -1, -1, 3}), 4.25);
  }

  TEST_CASE(
      "period: a sample that is 0 at a change of sign counts as one crossing, and a touch of 0 as none") {
    expect(value("period", {0, 1, 2, 3, 4, 5}, {0, 1, 0, -1, 0, 1}), 4);
    expect(value("period", {0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, 0, 1, -1, 0, -1, 1}), 6.5);
    expect(value("period", {0, 1, 2, 3, 4, 5, 6}, {-1e-18, 1, -1e-17, 1, 0, -1, 1}), 5.5);
    expect(value("period", {0, 1, 2, 3, 4, 5}, {0, 1, -1, 0.9e-9, 1.1e-9, 1}), 3);
    CHECK_FALSE(value("period", {0, 1, 2, 3}, {0, 0, 0, 0}));
    CHECK_FALSE(value("period", {0, 1, 2, 3}, {0, 1, -1, 0}));
  }

  TEST_CASE("first_peak: a parabola with unequal steps gives its exact signed peak") {
    const auto throw_up = [](double t) { return 3 * t * (1 - t); };
    const std::vector<double> times = {0, 0.1, 0.25, 0.4, 0.58, 0.9, 1.2};
    expect(value("first_peak", sampled(times, throw_up)), 0.75);
    expect(value("first_peak", sampled(times, [&](double t) { return -throw_up(t); })), -0.75);
  }

  TEST_CASE("first_peak: the peak is absent until the half cycle is over and then fixed") {
    const auto wave = [](double t) { return std::exp(0.5 * t) * std::sin(pi * t); };
    // y' = 0 where tan πt = −2π
    const double top = (pi - std::atan(2 * pi)) / pi;
    const double peak = std::exp(0.5 * top) * std::sin(pi * top);
    CHECK_FALSE(value("first_peak", sampled(unequal_times(0.99, 1e-3), wave)));
    expect(value("first_peak", sampled(unequal_times(1.01, 1e-3), wave)), peak, 1e-7);
    expect(value("first_peak", sampled(unequal_times(9, 1e-3), wave)), peak, 1e-7);
  }

  TEST_CASE("first_peak: two equal samples have the peak between them") {
    expect(value("first_peak", {0, 1, 2, 3, 4}, {0, 2, 2, 0, -1}), 2.25);
  }

  TEST_CASE("peak_time: a parabola gives its exact time, and no value until the half cycle is over") {
    const auto throw_up = [](double t) { return 3 * t * (1 - t); };
    expect(value("peak_time", sampled({0, 0.1, 0.25, 0.4, 0.58, 0.9, 1.2}, throw_up)), 0.5);
    expect(value("peak_time", {0, 1, 2, 3, 4}, {0, -2, -2, 0, 1}), 1.5);
    CHECK_FALSE(value("peak_time", sampled({0, 0.1, 0.25, 0.4, 0.58, 0.9}, throw_up)));
  }

  TEST_CASE("decay: the loss per period follows from the peaks with the sign of the first peak") {
    for (const double loss : {0.2, 0.0, -0.1}) {
      for (const double sign : {1.0, -1.0}) {
        const auto wave = [=](double t) { return sign * std::pow(1 - loss, t) * std::sin(2 * pi * t); };
        const auto found = value("decay", sampled(unequal_times(4.6, 1e-3), wave));
        REQUIRE(found);
        CHECK(std::abs(*found - loss) < 1e-6);
      }
    }
  }

  TEST_CASE("decay: the decay of a steady lopsided wave is 0") {
    const auto lopsided = [](double t) {
      return std::sin(2 * pi * t) * (std::sin(2 * pi * t) > 0 ? 1 : 0.3);
    };
    const auto found = value("decay", sampled(unequal_times(2.1, 1e-3), lopsided));
    REQUIRE(found);
    CHECK(std::abs(*found) < 1e-6);
  }

  TEST_CASE("decay: the measure is absent until two half cycles of the same sign are over") {
    const auto wave = [](double t) { return std::sin(2 * pi * t); };
    CHECK_FALSE(value("decay", sampled(unequal_times(1.49, 1e-3), wave)));
    CHECK(value("decay", sampled(unequal_times(1.51, 1e-3), wave)));
  }

  TEST_CASE(
      "period: a one-sided oscillation has a period about its mean, but none about 0, and `why` gives the reason") {
    const double T = 0.254, loss = 0.4;
    const auto swing = [=](double t) {
      return -0.03 * (1 - std::exp(-loss * t / T) * std::cos(2 * pi * t / T)) + 2e-4 * std::sin(40 * t / T);
    };
    for (const double cycles : {1.3, 1.6, 2.4, 3.7, 5.1}) {
      CAPTURE(cycles);
      const Series series = sampled(unequal_times(cycles * T, 1e-4), swing);
      Scene scene = scene_of("period");
      const MeasureResult none = result(scene, series);
      CHECK_FALSE(none.value);
      CHECK(none.why.find("the series stays on one side of 0") == 0);
      CHECK(none.why.find("about = \"mean\"") != std::string::npos);
      scene.measures[0].about_mean = true;
      expect(result(scene, series).value, T, 0.01);
      CHECK(result(scene, series).why.empty());
      scene.measures[0].about_mean = false;
      scene.measures[0].about = -0.03;
      expect(result(scene, series).value, T, 0.01);
    }
  }

  TEST_CASE("period: without a whole cycle about the mean there is no period, and `why` gives the reason") {
    Scene scene = scene_of("period");
    scene.measures[0].about_mean = true;
    const auto swing = [](double t) { return 1 - std::cos(2 * pi * t); };
    const MeasureResult none = result(scene, sampled(unequal_times(0.9, 1e-3), swing));
    CHECK_FALSE(none.value);
    CHECK(none.why.find("there is no whole cycle about the mean until 0.9") == 0);
    CHECK_FALSE(result(scene, sampled({0, 1, 2, 3}, [](double) { return 5; })).value);
    CHECK_FALSE(result(scene, sampled({0, 1, 2, 3}, [](double t) { return t; })).value);
    CHECK(result(scene, Series{{}, {{}, {}}}).why == "the series is not finite at its start");
  }

  TEST_CASE("period: noise of a fiftieth of the amplitude adds no crossings of the level") {
    Scene scene = scene_of("period");
    scene.measures[0].about_mean = true;
    unsigned state = 1;
    const auto noise = [&] {
      state = 1664525 * state + 1013904223;
      return state / 2147483648.0 - 1;
    };
    const auto swing = [&](double t) { return 0.2 - std::cos(2 * pi * t) + 0.02 * noise(); };
    expect(result(scene, sampled(unequal_times(4.8, 1e-3), swing)).value, 1, 0.01);
  }

  TEST_CASE("mean of whole periods: a sine of any phase, cut off anywhere, gives its level to 1e-5") {
    for (const double phase : {0.0, 0.4, 1.0, 2.5, 4.0}) {
      for (const double end : {1.9, 2.3, 3.45}) {
        const Series series =
            sampled(unequal_times(end, 1e-4), [=](double t) { return 3 + 2 * std::sin(2 * pi * t + phase); });
        const auto mean = mean_of_periods({series.time, series.value[0]});
        REQUIRE(mean);
        CHECK(std::abs(*mean - 3) < 1e-5);
      }
    }
  }

  TEST_CASE("first_peak, peak_time, decay: measures about a level start at the first crossing") {
    Scene scene = scene_of("first_peak");
    const auto swing = [](double t) { return 5 - 2 * std::pow(0.8, t) * std::cos(2 * pi * t); };
    const Series series = sampled(unequal_times(4.3, 1e-4), swing);
    scene.measures[0].about = 5;
    // 2π tan(2πt) = ln 0.8
    const double top = 0.5 + std::atan(std::log(0.8) / (2 * pi)) / (2 * pi);
    expect(result(scene, series).value, swing(top) - 5, 1e-6);
    scene.measures[0].kind = "peak_time";
    expect(result(scene, series).value, top, 1e-4);
    scene.measures[0].kind = "decay";
    expect(result(scene, series).value, 0.2, 1e-4);
    scene.measures[0].about = 0;
    CHECK(result(scene, series).why.find("the series stays on one side of 0") == 0);
  }

  TEST_CASE("mean, integral: both use the series from `from` to `until`, or are absent with a reason") {
    Scene scene = scene_of("mean");
    const Series series{{0, 0.1, 0.5, 0.9, 1.2}, {{1, 1.1, 1.5, 1.9, 2.2}}};
    expect(result(scene, series).value, 1.5);
    scene.measures[0].from = 0.2;
    scene.measures[0].until = 0.7;
    expect(result(scene, series).value, 1.45);
    scene.measures[0].kind = "integral";
    expect(result(scene, series).value, 0.725);
    scene.measures[0].until = 1.3;
    CHECK_FALSE(result(scene, series).value);
    CHECK(result(scene, series).why == "the run ends at 1.2 s, before 1.3 s");
    scene.measures[0].until = {};
    scene.measures[0].from = 1;
    CHECK(result(scene, series).why.find("`from` is 1 s; it must be before") == 0);
  }

  TEST_CASE("integral: a force sampled as means over steps gives its impulse to round-off") {
    Scene scene = scene_of("integral");
    scene.probes[0].kind = Probe::Kind::reaction;
    const Series series{{0, 0.1, 0.5, 0.9, 1.2}, {{0, 3, -1, 2, 5}}};
    expect(result(scene, series).value, 0.3 - 0.4 + 0.8 + 0.5);
    scene.measures[0].from = 0.2;
    scene.measures[0].until = 0.6;
    expect(result(scene, series).value, -0.3 + 0.2);
    scene.measures[0].kind = "mean";
    expect(result(scene, series).value, -0.1 / 0.4);
  }

  TEST_CASE("why: the reason names the probe and the time at which its series stops being finite") {
    const Series broken{{0, 1, 2, 3}, {{0, 1, std::nan(""), 1}}};
    CHECK(result(scene_of("period"), broken).why == "y is not finite at 2 s");
  }
}

}  // namespace of_this_file
