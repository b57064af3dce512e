// Measures of what swings: period, first peak, its time, decay.

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "tests/support/measured.hpp"

using namespace taut;
using namespace taut::test;
using doctest::Approx;

TEST_SUITE("unit") {
  TEST_CASE("period: of a sine of either sign with unequal steps") {
    const double T = 0.254;
    for (const double sign : {1.0, -1.0}) {
      const auto wave = [=](double t) { return sign * 0.1 * std::sin(2 * pi * t / T); };
      // linear between steps h: the zero of a sine, which bends like t³ there, is off by at most ~ (2π
      // h/T)²/T h
      expect(value("period", sampled(unequal_times(0.5, 1e-4), wave)), T, 1e-6);
      CHECK_FALSE(value("period", sampled(unequal_times(0.99 * T, 1e-4), wave)));
    }
  }

  TEST_CASE("period: linear between steps") {
    expect(value("period", {0, 1, 2, 4, 5}, {0, 3, -1, -1, 3}), 4.25);
  }

  TEST_CASE("period: a step that hits zero exactly counts once, one that touches it not at all") {
    expect(value("period", {0, 1, 2, 3, 4, 5}, {0, 1, 0, -1, 0, 1}), 4);
    expect(value("period", {0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, 0, 1, -1, 0, -1, 1}), 6.5);
    // neither does round-off, at the start or on the way
    expect(value("period", {0, 1, 2, 3, 4, 5, 6}, {-1e-18, 1, -1e-17, 1, 0, -1, 1}), 5.5);
    expect(value("period", {0, 1, 2, 3, 4, 5}, {0, 1, -1, 0.9e-9, 1.1e-9, 1}), 3);
    CHECK_FALSE(value("period", {0, 1, 2, 3}, {0, 0, 0, 0}));
    CHECK_FALSE(value("period", {0, 1, 2, 3}, {0, 1, -1, 0}));  // may only touch it
  }

  TEST_CASE("first_peak: exact for a parabola with unequal steps, with its sign") {
    const auto throw_up = [](double t) { return 3 * t * (1 - t); };  // back at 0 at t = 1, top 0.75
    const std::vector<double> times = {0, 0.1, 0.25, 0.4, 0.58, 0.9, 1.2};
    expect(value("first_peak", sampled(times, throw_up)), 0.75);
    expect(value("first_peak", sampled(times, [&](double t) { return -throw_up(t); })), -0.75);
  }

  TEST_CASE("first_peak: none until the half cycle is over, then it stays") {
    const auto wave = [](double t) {
      return std::exp(0.5 * t) * std::sin(pi * t);
    };  // later peaks are greater
    // y' = 0: tan πt = −2π; y = e^{t/2} sin πt there
    const double top = (pi - std::atan(2 * pi)) / pi;
    const double peak = std::exp(0.5 * top) * std::sin(pi * top);
    CHECK_FALSE(value("first_peak", sampled(unequal_times(0.99, 1e-3), wave)));
    expect(value("first_peak", sampled(unequal_times(1.01, 1e-3), wave)), peak, 1e-7);
    expect(value("first_peak", sampled(unequal_times(9, 1e-3), wave)), peak, 1e-7);
  }

  TEST_CASE("first_peak: two equal samples have the peak between them") {
    expect(value("first_peak", {0, 1, 2, 3, 4}, {0, 2, 2, 0, -1}), 2.25);
  }

  TEST_CASE("peak_time: exact for a parabola with unequal steps, none until the half cycle is over") {
    const auto throw_up = [](double t) { return 3 * t * (1 - t); };
    expect(value("peak_time", sampled({0, 0.1, 0.25, 0.4, 0.58, 0.9, 1.2}, throw_up)), 0.5);
    expect(value("peak_time", {0, 1, 2, 3, 4}, {0, -2, -2, 0, 1}), 1.5);
    CHECK_FALSE(value("peak_time", sampled({0, 0.1, 0.25, 0.4, 0.58, 0.9}, throw_up)));
  }

  TEST_CASE("decay: the loss per period of a damped wave, from the peaks of the first one's side") {
    for (const double loss : {0.2, 0.0, -0.1}) {
      for (const double sign : {1.0, -1.0}) {
        const auto wave = [=](double t) { return sign * std::pow(1 - loss, t) * std::sin(2 * pi * t); };
        const auto found = value("decay", sampled(unequal_times(4.6, 1e-3), wave));
        REQUIRE(found);
        CHECK(std::abs(*found - loss) < 1e-6);
      }
    }
  }

  TEST_CASE("decay: an even wave about another mean is judged by one side only") {
    const auto lopsided = [](double t) {
      return std::sin(2 * pi * t) * (std::sin(2 * pi * t) > 0 ? 1 : 0.3);
    };
    const auto found = value("decay", sampled(unequal_times(2.1, 1e-3), lopsided));
    REQUIRE(found);
    CHECK(std::abs(*found) < 1e-6);
  }

  TEST_CASE("decay: none with fewer than two peaks of one side") {
    const auto wave = [](double t) { return std::sin(2 * pi * t); };
    CHECK_FALSE(value("decay", sampled(unequal_times(1.49, 1e-3), wave)));
    CHECK(value("decay", sampled(unequal_times(1.51, 1e-3), wave)));
  }
}
