#include <array>
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
#include "engine/diagnostics/measures.hpp"
#include "engine/error.hpp"
#include "engine/judge/verdict.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/simulation.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;
using namespace taut::cli;

namespace {

struct Rest {
  std::map<std::string, MeasureResult> measure;
  Verdict verdict = Verdict::stable;

  double value(const std::string& name) const {
    REQUIRE(measure.at(name).value);
    return *measure.at(name).value;
  }
  double error(const std::string& name) const {
    REQUIRE(measure.at(name).error);
    return *measure.at(name).error;
  }
};

SceneFile scene(const std::string& name, const std::string& method, double spacing,
                std::vector<Setting> settings = {}) {
  settings.push_back({"method", method});
  settings.push_back({"spacing", exact(spacing)});
  SceneFile file = read_scene(find_scene(name), settings);
  file.settings.threads = 1;
  return file;
}

Rest run(const SceneFile& file) {
  constexpr int looks = 40;
  const auto simulation = make_simulation(file.scene, file.settings);
  Judge judge(file.scene, *simulation);
  Rest rest;
  try {
    for (int k = 1; k <= looks && judge.verdict() != Verdict::diverged; ++k) {
      simulation->advance_to(file.scene.until * k / looks);
      judge.observe(simulation->snapshot(), balance(simulation->snapshot(), file.scene));
    }
    rest.verdict = judge.verdict();
  } catch (const NumericalError&) {
    rest.verdict = Verdict::diverged;
  }
  const auto results = measure(file.scene, simulation->series(),
                               find_method(file.settings.method)->material_law, {}, &simulation->snapshot());
  for (const MeasureResult& result : results) rest.measure[result.name] = result;
  return rest;
}

/// Relative errors of σ_rθ at small strains.
struct ShearError {
  double rms = 0, worst = 0;
};

ShearError shear_error(const std::string& method, double spacing) {
  const double load = 0.02, q = load * 1.7227e-9, a = 2.5e-4;
  const SceneFile file = scene("sheared-annulus", method, spacing, {{"load", exact(load)}});
  const auto simulation = make_simulation(file.scene, file.settings);
  simulation->advance_to(file.scene.until);
  const Snapshot& now = simulation->snapshot();
  double difference = 0, size = 0, worst = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Point X = now.initial(i);
    const double r = std::hypot(X[0], X[1]), c = X[0] / r, s = X[1] / r;
    if (r < a + spacing) continue;
    const StressTensor sigma = now.stress(i);
    const double shear = sigma.xy * (c * c - s * s) + (sigma.yy - sigma.xx) * c * s;
    difference += std::pow(shear - q / (r * r), 2);
    size += std::pow(q / (r * r), 2);
    worst = std::max(worst, std::abs(shear / (q / (r * r)) - 1));
  }
  return {std::sqrt(difference / size), worst};
}

/// Tip (x, y)/L of a beam with theta'' = −a cos theta, theta(0) = 0, theta'(1) = 0, by shooting; y along the force.
std::array<double, 2> elastica(double a) {
  using State = std::array<double, 4>;  // theta, theta', x, y
  const auto rate = [a](const State& s) {
    return State{s[1], -a * std::cos(s[0]), std::cos(s[0]), std::sin(s[0])};
  };
  const auto plus = [](const State& s, double h, const State& r) {
    return State{s[0] + h * r[0], s[1] + h * r[1], s[2] + h * r[2], s[3] + h * r[3]};
  };
  const auto shoot = [&](double bend) {
    constexpr int steps = 400;
    const double h = 1.0 / steps;
    State s{0, bend, 0, 0};
    for (int k = 0; k < steps; ++k) {
      const State r1 = rate(s), r2 = rate(plus(s, h / 2, r1)), r3 = rate(plus(s, h / 2, r2)),
                  r4 = rate(plus(s, h, r3));
      for (std::size_t c = 0; c < 4; ++c) s[c] += h / 6 * (r1[c] + 2 * r2[c] + 2 * r3[c] + r4[c]);
    }
    return s;
  };
  double low = 0, high = 2 * a;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (shoot(middle)[1] < 0 ? low : high) = middle;
  }
  const State tip = shoot(low);
  return {tip[2], tip[3]};
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("elastica: the series of the reference solves the thin beam for small and large forces") {
    for (const double force : {-10.0, 25.0, 150.0, 249.0}) {
      CAPTURE(force);
      const SceneFile file =
          scene("beam-bending", "icb", 0.002, {{"force", std::to_string(force)}, {"L", "0.21"}});
      const Reference& reference = file.scene.references.at("neo_hookean");
      CHECK(reference.name == "elastica");
      const double a = std::abs(force) * 0.21 * 0.21 / (2e7 * 0.02 * 0.02 * 0.02 / 12);
      const auto [x, y] = elastica(a);
      const double down = force > 0 ? -1 : 1;
      CHECK(reference.solution.at("deflection_x").at(0)({}, 0) == Approx(0.21 * (x - 1)).epsilon(1e-4));
      CHECK(reference.solution.at("deflection_y").at(0)({}, 0) == Approx(down * 0.21 * y).epsilon(1e-4));
    }
    CHECK(scene("beam-bending", "icb", 0.002).scene.references.at("neo_hookean").value.at("deflection_y") ==
          -47.441e-3);
  }

  TEST_CASE("truss: the stress at the exact extensions of icb and St Venant–Kirchhoff balances the force") {
    for (const double force : {-7000.0, 3000.0, 7000.0}) {
      const auto stretch = [&](const char* method, const char* law) {
        const SceneFile file = scene("truss", method, 0.005, {{"force", std::to_string(force)}});
        return 1 + file.scene.references.at(law).solution.at("extension").at(0)({}, 0) / 0.2;
      };
      // second Piola–Kirchhoff stress times section
      const auto turned = [](double s) { return 0.5 * (s * s - 1) * 1e5; };
      CHECK(turned(stretch("icb", "neo_hookean")) == Approx(force).epsilon(1e-9));
      const double s = stretch("tl", "st_venant_kirchhoff");
      CHECK(s * turned(s) == Approx(force).epsilon(1e-9));
      CHECK(stretch("tl", "neo_hookean") == Approx(1 + force / 1e5));
    }
  }

  TEST_CASE("truss: the extension of icb converges to the exact one with the spacing, also in compression") {
    for (const char* force : {"7000", "-3000"}) {
      const Rest coarse = run(scene("truss", "icb", 0.01, {{"force", force}}));
      const Rest fine = run(scene("truss", "icb", 0.005, {{"force", force}}));
      CHECK(fine.verdict == Verdict::stable);
      CHECK(fine.error("extension") < 0.045);
      CHECK(fine.error("extension") < 0.7 * coarse.error("extension"));
    }
  }

  TEST_CASE(
      "loaded square: normalised kernels come close to the exact field, and unnormalised kernels do not") {
    const Rest with = run(scene("loaded-square", "tl-small-strain", 2.5e-5));
    CHECK(with.error("displacement_rmse") < 0.02);
    CHECK(with.error("displacement_error") < 0.06);
    const Rest without = run(scene("loaded-square", "tl-small-strain", 2.5e-5, {{"method.normalised", "0"}}));
    CHECK(without.error("displacement_rmse") > 0.05);
    CHECK(without.error("displacement_error") > 0.3);
    const Rest heavy = run(scene("loaded-square", "tl-small-strain", 2.5e-5, {{"load", "64"}}));
    CHECK(heavy.value("displacement_rmse") == Approx(with.value("displacement_rmse")).epsilon(1e-5));
  }

  TEST_CASE(
      "sheared annulus: normalised kernels and a finer spacing bring the field closer to the exact one") {
    const double fine =
        run(scene("sheared-annulus", "tl-small-strain", 1.6667e-5)).error("displacement_rmse");
    CHECK(fine < 0.02);
    CHECK(run(scene("sheared-annulus", "tl-small-strain", 2.5e-5)).error("displacement_rmse") > 2 * fine);
    const auto without = scene("sheared-annulus", "tl-small-strain", 1.6667e-5, {{"method.normalised", "0"}});
    CHECK(run(without).error("displacement_rmse") > 2 * fine);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE(
      "sheared annulus: the shear stress of tl and oenog is correct farther than a spacing from the inner face") {
    for (const char* method : {"tl", "oenog"}) {
      CAPTURE(std::string(method));
      const ShearError fine = shear_error(method, 1e-5);
      CHECK(fine.rms < 0.02);
      CHECK(fine.worst < 0.05);
      CHECK(shear_error(method, 2e-5).rms > 1.8 * fine.rms);
    }
  }

  TEST_CASE("loaded square: the tension of tl and oenog at the loaded sides is close to the load") {
    const double k = 50 * 0.02, l = 5e-4;
    for (const auto& [method, most] : {std::pair("tl", 0.01), std::pair("oenog", 0.05)}) {
      const auto said = std::string(method);
      CAPTURE(said);
      SceneFile file = scene("loaded-square", method, 2.5e-5, {{"load", "0.02"}});
      const auto simulation = make_simulation(file.scene, file.settings);
      simulation->advance_to(file.scene.until);
      const Snapshot& now = simulation->snapshot();
      double difference = 0, size = 0;
      for (std::size_t i = 0; i < now.size(); ++i) {
        const Point X = now.initial(i);
        size += std::pow(k * X[1], 2) / static_cast<double>(now.size());
        if (std::abs(X[0]) > 0.5 * l - 2.5e-5) difference += std::pow(now.stress(i).xx + k * X[1], 2) / 40;
      }
      CHECK(std::sqrt(difference / size) < most);
    }
  }
}

TEST_SUITE("convergence") {
  TEST_CASE("bent beam: the deflection of icb converges to finite elements with the spacing") {
    const Rest coarse = run(scene("beam-bending", "icb", 0.004)),
               fine = run(scene("beam-bending", "icb", 0.0025));
    CHECK(fine.verdict == Verdict::stable);
    CHECK(fine.measure.at("deflection_y").reference_name == "finite elements, St Venant–Kirchhoff");
    CHECK(fine.error("deflection_y") < 0.035);
    CHECK(fine.error("deflection_y") < 0.4 * coarse.error("deflection_y"));
  }
}

TEST_SUITE("failure") {
  TEST_CASE("bent beam: the deflection of ccbwat is at least a fifth off") {
    const double error = run(scene("beam-bending", "ccbwat", 0.02 / 6)).error("deflection_y");
    CHECK(error > 0.2);
    CHECK(error < 0.3);
  }

  TEST_CASE("bent beam: ccb fails under a sudden force, and icb carries it") {
    const auto sudden = [](const char* method) {
      SceneFile file = scene("beam-bending", method, 0.0025, {{"zeta", "0"}, {"rise", "0"}});
      file.scene.until = 0.08;
      return run(file).verdict;
    };
    CHECK(sudden("ccb") != Verdict::stable);
    CHECK(sudden("icb") == Verdict::stable);
  }

  TEST_CASE("truss: ccb fails at a tension of 3000 N/m, ccbwat at 7000 N/m, and both carry compression") {
    const auto verdict = [](const char* method, const char* force) {
      return run(scene("truss", method, 0.005, {{"force", force}})).verdict;
    };
    CHECK(verdict("ccb", "3000") != Verdict::stable);
    CHECK(verdict("ccbwat", "3000") == Verdict::stable);
    CHECK(verdict("ccbwat", "7000") != Verdict::stable);
    CHECK(verdict("ccb", "-3000") == Verdict::stable);
    CHECK(verdict("ccbwat", "-7000") == Verdict::stable);
  }
}

}  // namespace of_this_file
