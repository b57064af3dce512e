#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/diagnostics/measures.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

double rate(const std::array<double, 3>& result) {
  return std::log2(std::abs((result[0] - result[1]) / (result[1] - result[2])));
}

}  // namespace

TEST_SUITE("convergence") {
  TEST_CASE("plate: small oscillations of enog with ten rows have a period from 0.25 to 0.27 s") {
    Scene scene = oscillating_plate(0.001);
    Measure period;
    period.name = "period";
    period.kind = "period";
    period.probes = {"tip"};
    scene.measures = {period};
    const auto simulation = make_simulation(scene, with_method("enog"));
    simulation->advance_to(0.275);
    const auto found = measure(scene, simulation->series(), "2d_deviator").at(0).value;
    REQUIRE(found.has_value());
    // finite elements: 0.2569 s; thin-plate theory and [Zhang2024] Table 1: 0.254 s and 0.262 s
    CHECK(*found > 0.25);
    CHECK(*found < 0.27);
  }

  TEST_CASE("plate: with smaller spacings the first peak of enog approaches a limit") {
    std::array<double, 3> peak{};
    for (std::size_t k = 0; k < peak.size(); ++k) {
      const int across = 5 << k;
      const auto simulation = make_simulation(oscillating_plate(0.001, across), with_method("enog"));
      simulation->advance_to(0.07);
      peak[k] = std::ranges::max(simulation->series().value[0]);
      CHECK(simulation->series().value[0].back() < peak[k]);
    }
    MESSAGE("order in the spacing: " << rate(peak));
    CHECK(rate(peak) > 0.9);
    CHECK(std::abs(peak[1] - peak[2]) < 0.02 * peak[2]);
  }

  TEST_CASE("plate: with smaller time steps every method except pf approaches a limit") {
    for (const MethodInfo& method : methods()) {
      const std::string name(method.name);
      if (name == "pf") continue;  // its zigzags grow without bound
      CAPTURE(name);
      std::array<double, 3> tip{};
      for (std::size_t k = 0; k < tip.size(); ++k) {
        Settings settings = with_method(name, Stepping::single);
        settings.cfl = 0.2 / static_cast<double>(1 << k);
        const auto simulation = make_simulation(oscillating_plate(0.01, 5), settings);
        simulation->advance_to(0.0201);
        tip[k] = value_at(simulation->series(), 0.02);
      }
      MESSAGE(name << ": order in the time step: " << rate(tip));
      CHECK(std::abs(tip[0]) > 1e-3);
      CHECK(std::abs(tip[0] - tip[1]) < 1e-4 * std::abs(tip[0]));
      if (name == "oenog")  // the remaining difference is the phase of fast waves
        CHECK(std::abs(tip[1] - tip[2]) < 1e-5 * std::abs(tip[0]));
      else
        CHECK(rate(tip) > 0.8);
    }
  }
}

}  // namespace of_this_file
