#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/curve.hpp"
#include "engine/diagnostics/lines.hpp"
#include "engine/diagnostics/measures.hpp"
#include "engine/error.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/simulation.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;
using namespace taut::cli;

namespace {

struct Outcome {
  std::map<std::string, std::optional<double>> measure;
  Balance start, end;
  double reached = 0;
  bool diverged = false;
};

Outcome run(const std::string& name, const std::string& method, double spacing,
            std::optional<double> until = {}, std::vector<Setting> settings = {}) {
  settings.push_back({"method", method});
  settings.push_back({"spacing", exact(spacing)});
  if (until) settings.push_back({"until", exact(*until)});
  SceneFile file = read_scene(find_scene(name), settings);
  file.settings.threads = 1;
  const auto simulation = make_simulation(file.scene, file.settings);
  Outcome outcome;
  outcome.start = balance(simulation->snapshot(), file.scene);
  try {
    simulation->advance_to(file.scene.until);
  } catch (const NumericalError&) {
    outcome.diverged = true;
  }
  outcome.reached = simulation->time();
  outcome.end = balance(simulation->snapshot(), file.scene);
  for (const MeasureResult& m : measure(file.scene, simulation->series(), find_method(method)->material_law))
    outcome.measure[m.name] = m.name.ends_with("_angle") ? m.error : m.value;
  return outcome;
}

}  // namespace

TEST_SUITE("convergence") {
  TEST_CASE("rotating plate: the corner of oenog converges to finite elements with the spacing") {
    const Outcome coarse = run("rotating-plate", "oenog", 0.1), fine = run("rotating-plate", "oenog", 0.05);
    REQUIRE(coarse.measure.at("corner_error"));
    REQUIRE(fine.measure.at("corner_error"));
    CHECK(*coarse.measure.at("corner_error") < 0.03);
    CHECK(*fine.measure.at("corner_error") < 0.012);
    CHECK(*fine.measure.at("corner_error") < 0.5 * *coarse.measure.at("corner_error"));
    CHECK(*fine.measure.at("corner_angle") < 1e-3);  // after three turns
  }
}

TEST_SUITE("convergence") {
  TEST_CASE(
      "elastic cable: a finer spacing reduces the error more under tensile control than with artificial stress") {
    // the cable of [Khayyer2024] Table 3, shortened to a quarter
    const auto error = [](const char* method, double spacing) {
      const auto cable = run("elastic-cable", method, spacing, 2.5e-3, {{"L", "2.5"}});
      REQUIRE(cable.measure.at("end_rmse"));
      return *cable.measure.at("end_rmse");
    };
    const double coarse = error("d-ulsph-r-tic", 0.05);
    // four rows have no interior, where the methods would differ
    CHECK(error("d-ulsph-r-as", 0.05) == coarse);
    CHECK(coarse > 1e-4);
    CHECK(error("d-ulsph-r-tic", 0.025) < 0.6 * coarse);
    CHECK(error("d-ulsph-r-as", 0.025) > 0.7 * coarse);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("elastic cable: d-ulsph-r-tic is no farther from the exact solution than published") {
    for (const auto& [spacing, published] : {std::pair(0.05, 4.88234e-4), {0.025, 2.44817e-4}}) {
      const auto cable = run("elastic-cable", "d-ulsph-r-tic", spacing, 0.01, {});
      REQUIRE(cable.measure.at("end_rmse"));
      CHECK(*cable.measure.at("end_rmse") < published);
      CHECK(*cable.measure.at("end_rmse") > 0.9 * published);
    }
  }

  TEST_CASE("heterogeneous cable: the stress of d-ulsph-r-tic follows the rod theory through the interface") {
    SceneFile file =
        read_scene(find_scene("heterogeneous-cable"), {{"method", "d-ulsph-r-tic"}, {"spacing", "0.0096"}});
    file.settings.threads = 1;
    const auto simulation = make_simulation(file.scene, file.settings);
    LineRecorder lines(file.scene, simulation->snapshot(), simulation->support());
    for (lines.sample(simulation->snapshot()); std::isfinite(lines.next());
         lines.sample(simulation->snapshot()))
      simulation->advance_to(lines.next());
    const MeasureResult rmse =
        measure(file.scene, simulation->series(), "neo_hookean", lines.samples()).at(0);
    REQUIRE(rmse.value);
    CHECK(rmse.reference_name == "rod theory, M of plane strain");
    CHECK(*rmse.value < 1e6);
  }

  TEST_CASE("elastic cable: the end of oenog follows the exact solution") {
    const Outcome cable = run("elastic-cable", "oenog", 0.1, 5e-3);
    REQUIRE(cable.measure.at("end_rmse"));
    CHECK(*cable.measure.at("end_rmse") < 1e-4);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE(
      "oblique discs: total Lagrangian methods do not spin smooth discs by default, and tl does with penalty") {
    const auto spin = [](const char* method, const char* contact) {
      CAPTURE(std::string(method));
      const auto value = run("oblique-discs", method, 0.002, {}, {{"contact", contact}}).measure.at("spin");
      REQUIRE(value);
      return std::abs(*value);
    };
    for (const char* method : {"tl", "tl-hg", "tl-enog", "pf-jst", "pfj-jst", "pfhj-jst"})
      CHECK(spin(method, "published") < 0.01);
    CHECK(spin("tl", "penalty") > 0.1);
  }

  TEST_CASE("ringing ring: the period is constant, and converges to the exact one with the spacing") {
    const auto period = [](double spacing, double& later) {
      SceneFile file =
          read_scene(find_scene("ringing-ring"), {{"method", "tl"}, {"spacing", exact(spacing)}});
      file.settings.threads = 1;
      const auto simulation = make_simulation(file.scene, file.settings);
      simulation->advance_to(file.scene.until);
      const Series& series = simulation->series();
      const std::vector<HalfCycle> cycles = half_cycles({series.time, series.value.at(0)});
      REQUIRE(cycles.size() == 5);
      later = cycles[4].end - cycles[2].end;
      return *measure(file.scene, series, "neo_hookean").at(0).value;
    };
    double coarse_later = 0, fine_later = 0;
    const double coarse = period(0.001, coarse_later), fine = period(0.0005, fine_later);
    CHECK(std::abs(coarse / coarse_later - 1) < 5e-5);
    CHECK(std::abs(fine / fine_later - 1) < 5e-5);
    // second-order extrapolation
    const double limit = fine - (coarse - fine) / 3;
    CHECK(std::abs(limit / 10.40371e-3 - 1) < 1e-3);
  }

  TEST_CASE("ringing ring: half the initial speed gives half the amplitude and the same period") {
    const Outcome whole = run("ringing-ring", "oenog", 0.002, {}, {{"v0", "1e-4"}});
    const Outcome half = run("ringing-ring", "oenog", 0.002, {}, {{"v0", "5e-5"}});
    REQUIRE(whole.measure.at("first_peak"));
    REQUIRE(half.measure.at("first_peak"));
    CHECK(*half.measure.at("first_peak") / *whole.measure.at("first_peak") == Approx(0.5).epsilon(2e-4));
    CHECK(*half.measure.at("period") / *whole.measure.at("period") == Approx(1).epsilon(1e-5));
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("rotating plate: oenog conserves the angular momentum over three turns to round-off") {
    const Outcome plate = run("rotating-plate", "oenog", 0.1);
    const double start = plate.start.angular_momentum[2];
    REQUIRE(start > 19000);  // ω ρ/6 = 19250, slightly less on a lattice
    CHECK(plate.reached >= 0.2);
    CHECK(std::abs(plate.end.angular_momentum[2] / start - 1) < 1e-12);
  }
}

TEST_SUITE("failure") {
  TEST_CASE("rotating plate: enog gains angular momentum until the plate diverges or doubles its energy") {
    const Outcome early = run("rotating-plate", "enog", 0.04, 0.015);
    CHECK(early.end.angular_momentum[2] > 1.01 * early.start.angular_momentum[2]);
    const Outcome late = run("rotating-plate", "enog", 0.04, 0.09);
    const double energy = late.end.kinetic + late.end.strain;
    CHECK((late.diverged || energy > 2 * (late.start.kinetic + late.start.strain)));
  }
}

}  // namespace of_this_file
