#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <optional>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/spectrum.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

/// Lines on a slope, with the decay rate `damping`.
struct Ringing {
  std::vector<double> t, y;

  explicit Ringing(double damping = 0) {
    for (double time = 0; time <= 0.2 + 1e-5; time += 1e-5 * (1.2 + std::sin(4e4 * time))) {
      t.push_back(time);
      const auto line = [&](double f, double phase) {
        return std::exp(-damping * time) * std::sin(2 * std::numbers::pi * f * time + phase);
      };
      y.push_back(3 + 0.1 * time + 0.5 * line(150.3, 0.2) + 0.05 * line(357.1, 1) + 0.3 * line(446.2, 2));
    }
  }
  std::optional<double> peak(double low, double high, double begin = 0, double end = 0.2) const {
    return peak_frequency({t, y}, begin, end, {low, high});
  }
};

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("spectrum: lines are located far more accurately than the spectrum's spacing") {
    const Ringing steady, dying(10);
    for (const Ringing* curve : {&steady, &dying}) {
      CHECK(*curve->peak(75, 250) == Approx(150.3).epsilon(3e-4));
      CHECK(*curve->peak(260, 400) == Approx(357.1).epsilon(3e-4));
      CHECK(*curve->peak(400, 600) == Approx(446.2).epsilon(3e-4));
      CHECK(*curve->peak(0, 1000) == Approx(150.3).epsilon(3e-4));
      CHECK(*curve->peak(75, 250, 0.05, 0.15) == Approx(150.3).epsilon(3e-3));
    }
  }
  TEST_CASE("spectrum: the symmetric window keeps a weak line beside a strong one visible") {
    // without a window, leakage of the strong line exceeds the weak line
    std::vector<double> t, y, back;
    for (int k = 0; k <= 8192; ++k) {
      const double time = 0.2 * k / 8192, two_pi = 2 * std::numbers::pi;
      t.push_back(time);
      y.push_back(std::sin(two_pi * 152.4 * time) + 5e-4 * std::sin(two_pi * 452.7 * time + 1));
    }
    back.assign(y.rbegin(), y.rend());
    for (const std::vector<double>* values : {&y, &back}) {
      const auto weak = peak_frequency({t, *values}, 0, 0.2, {300, 600});
      REQUIRE(weak);
      CHECK(*weak == Approx(452.7).epsilon(3e-4));
    }
  }
  TEST_CASE("spectrum: neither the flank of a line nor the end of a band is a line") {
    const Ringing curve;
    CHECK(!curve.peak(146, 149));
    CHECK(!curve.peak(151.5, 154));
    CHECK(!peak_frequency({}, 0, 1, {1, 2}));
    // the first side lobe of the window is no line
    std::vector<double> t, y;
    for (int k = 0; k <= 2000; ++k) {
      t.push_back(1e-4 * k);
      y.push_back(std::sin(2 * std::numbers::pi * 50 * t.back()) +
                  0.3 * std::sin(2 * std::numbers::pi * 120 * t.back()));
    }
    CHECK(!peak_frequency({t, y}, 0, 0.2, {60, 80}));
    CHECK(*peak_frequency({t, y}, 0, 0.2, {100, 200}) == Approx(120).epsilon(1e-3));
    CHECK(!curve.peak(75, 250, 0.1, 0.1));
  }

  TEST_CASE("spectrum: a curve that does not oscillate has no line in any band") {
    using Signal = double (*)(double);
    const Signal signals[] = {[](double) { return 3.0; },
                              [](double t) { return t - 0.01; },
                              [](double t) { return 4.9 * t * t; },
                              [](double t) { return std::exp(-t / 0.01); },
                              [](double t) { return std::exp(-std::pow((t - 0.02) / 0.002, 2)); },
                              [](double t) { return t > 0.013 ? 1.0 : 0.0; }};
    for (const double end : {0.04, 0.2, 0.5})
      for (std::size_t signal = 0; signal < std::size(signals); ++signal) {
        CAPTURE(end);
        CAPTURE(signal);
        std::vector<double> t, y;
        for (int k = 0; k <= 4000; ++k) t.push_back(end * k / 4000), y.push_back(signals[signal](t.back()));
        for (const double low : {0.0, 20.0, 200.0})
          CHECK(peak_frequency({t, y}, 0, end, {low, 1000}).value_or(0) == 0);
        if (end < 0.1) continue;
        for (std::size_t k = 0; k < t.size(); ++k) y[k] += 0.1 * std::sin(2 * std::numbers::pi * 300 * t[k]);
        CHECK(*peak_frequency({t, y}, 0, end, {200, 400}) == Approx(300).epsilon(2e-3));
      }
  }

  TEST_CASE("spectrum: an oscillation on a drift has its line, also with few periods") {
    for (const double periods : {2.5, 3.0, 4.0, 5.25, 6.0, 9.0}) {
      CAPTURE(periods);
      std::vector<double> t, y, line;
      for (int k = 0; k <= 4000; ++k) {
        t.push_back(k / 4000.0);
        y.push_back(t.back() + 0.1 * std::sin(2 * std::numbers::pi * periods * t.back()));
        line.push_back(std::sin(2 * std::numbers::pi * 100.3 * t.back()));
      }
      const auto found = peak_frequency({t, y}, 0, 1, {1, 20});
      REQUIRE(found);
      CHECK(*found == Approx(periods).epsilon(0.06));
      for (const double low : {10.0, 40.0, 90.0}) CHECK(!peak_frequency({t, line}, 0, 1, {low, 97}));
    }
  }

  TEST_CASE("spectrum: many samples of a curve with two jumps have no line") {
    std::vector<double> t, y;
    for (int k = 0; k <= 300000; ++k)
      t.push_back(k / 3e5), y.push_back((t.back() > 0.3) + 0.7 * (t.back() > 0.7));
    CHECK(!peak_frequency({t, y}, 0, 1, {10, 1e9}));
  }

  TEST_CASE("spectrum: few periods and a fast decay still give the line") {
    for (const double f : {12.0, 15.0, 22.0, 30.0, 60.0})
      for (const double decay : {0.0, 5.0, 20.0}) {
        CAPTURE(f);
        CAPTURE(decay);
        std::vector<double> t, y;
        for (int k = 0; k <= 2000; ++k) {
          t.push_back(0.2 * k / 2000);
          y.push_back(1 + std::exp(-decay * t.back()) * std::cos(2 * std::numbers::pi * f * t.back()));
        }
        const auto found = peak_frequency({t, y}, 0, 0.2, {5, 100});
        REQUIRE(found);
        CHECK(*found == Approx(f).epsilon(0.06));
      }
  }
}

}  // namespace of_this_file
