#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/indicators.hpp"
#include "engine/diagnostics/measures.hpp"
#include "engine/judge/verdict.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/scene/shapes/round_shapes.hpp"
#include "engine/simulation.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::cli;
using taut::test::relative;

namespace {

SceneFile scene(const std::string& name, double spacing, std::vector<Setting> settings = {},
                const std::string& method = "oenog") {
  settings.push_back({"method", method});
  settings.push_back({"spacing", exact(spacing)});
  SceneFile file = read_scene(find_scene(name), settings);
  file.settings.threads = 1;
  return file;
}

struct Whole {
  SceneFile file;
  std::unique_ptr<Simulation> simulation;

  explicit Whole(SceneFile of) : file(std::move(of)), simulation(make_simulation(file.scene, file.settings)) {
    simulation->advance_to(file.scene.until);
  }
  double measured(const std::string& name) const {
    const std::string_view law = find_method(file.settings.method)->material_law;
    for (const MeasureResult& result : measure(file.scene, simulation->series(), law)) {
      if (result.name != name) continue;
      REQUIRE(result.value);
      return *result.value;
    }
    FAIL("no measure " << name);
    return 0;
  }
  const std::vector<double>& probe(const std::string& name) const {
    const auto found = std::ranges::find(file.scene.probes, name, &Probe::name);
    REQUIRE(found != file.scene.probes.end());
    return simulation->series().value.at(static_cast<std::size_t>(found - file.scene.probes.begin()));
  }
};

/// Order p of an error ∝ spacing^p.
double order(double coarse, double fine, double ratio) { return std::log(coarse / fine) / std::log(ratio); }

SceneFile askew_rings(double spacing, double across) {
  SceneFile file = scene("colliding-rings", spacing);
  for (Shape& shape : file.scene.bodies.at(1).shapes) shape.shift(1, across);
  return file;
}

Judge judged(const SceneFile& file) {
  constexpr int looks = 1000;
  const auto simulation = make_simulation(file.scene, file.settings);
  Judge judge(file.scene, *simulation);
  IndicatorGauge gauge(file.scene, simulation->snapshot());
  for (int k = 1; k <= looks && judge.verdict() != Verdict::diverged; ++k) {
    simulation->advance_to(file.scene.until * k / looks);
    const Snapshot& now = simulation->snapshot();
    judge.observe(now, balance(now, file.scene), gauge(now));
  }
  return judge;
}

}  // namespace

TEST_SUITE("convergence") {
  TEST_CASE("ringing ring: the period of oenog converges to the exact one with order 1.5 at least") {
    const double exact_period = 10.40371e-3;
    const auto error = [exact_period](double spacing) {
      return Whole(scene("ringing-ring", spacing)).measured("period") / exact_period - 1;
    };
    // the error does not change its sign
    const double coarse = error(0.002), middle = error(0.00125), fine = error(0.001);
    CHECK(coarse > -2e-3);
    CHECK(coarse < middle);
    CHECK(middle < fine);
    CHECK(fine < 0);
    CHECK(order(-coarse, -fine, 2) > 1.5);
  }

  TEST_CASE("ringing ring: a relaxed layout has less than a third of the error of the cut lattice") {
    const auto error = [](const std::string& method, bool relaxed) {
      SceneFile file = scene("ringing-ring", 0.00125, {}, method);
      file.scene.until = 0.0125;
      Body& ring = file.scene.bodies.at(0);
      ring.relaxed = relaxed;
      ring.shapes = {Ring{{0, 0, 0}, 0.03, 0.04, RoundLayout::lattice}};
      return Whole(std::move(file)).measured("period") / 10.40371e-3 - 1;
    };
    CHECK(std::abs(error("oenog", true)) < 0.015);
    CHECK(error("oenog", false) > 0.045);
    CHECK(std::abs(error("tl", true)) < 0.04);
    CHECK(error("tl", false) > 0.12);
  }

  TEST_CASE(
      "colliding rings: with oenog diameter and speed converge to finite elements with order 1 at least") {
    const Whole coarse(scene("colliding-rings", 0.002)), fine(scene("colliding-rings", 0.001));
    for (const char* line : {"diameter_rmse", "speed_rmse"}) {
      CAPTURE(std::string(line));
      CHECK(fine.measured(line) < 0.005);
      CHECK(order(coarse.measured(line), fine.measured(line), 2) > 1);
    }
    for (const Whole* rings : {&coarse, &fine}) {
      // exact for any spacing
      CHECK(std::abs(rings->measured("touch_time") - 0.01 / (2 * 7.071068)) < 1e-7);
      CHECK(rings->measured("mirror_asymmetry") == 0);
    }
    CHECK(std::abs(fine.measured("rebound_ratio") / 0.8107 - 1) < 0.005);
  }

  TEST_CASE(
      "colliding rings: with enog diameter and speed are 2 to 3 % off finite elements of its own material") {
    const Whole rings(scene("colliding-rings", 0.001, {}, "enog"));
    for (const char* line : {"diameter_rmse", "speed_rmse"}) {
      CAPTURE(std::string(line));
      CHECK(rings.measured(line) < 0.03);
      CHECK(rings.measured(line) > 0.02);
    }
  }

  TEST_CASE(
      "ball and plate: with oenog deflection and speed converge to finite elements with order 1.5 at least") {
    const Whole coarse(scene("ball-plate", 0.004)), fine(scene("ball-plate", 0.0025));
    for (const char* line : {"deflection_rmse", "speed_rmse"}) {
      CAPTURE(std::string(line));
      CHECK(coarse.measured(line) < 0.012);
      CHECK(fine.measured(line) < 0.004);
      CHECK(order(coarse.measured(line), fine.measured(line), 1.6) > 1.5);
    }
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("colliding rings: without damping oenog rebounds like finite elements") {
    const Whole rings(scene("colliding-rings", 0.001, {{"method.damping", "0"}}));
    CHECK(std::abs(rings.measured("rebound_ratio") / 0.8107 - 1) < 0.005);
  }

  TEST_CASE(
      "colliding rings: the rebound of oenog does not depend on the offset between particles of the faces") {
    constexpr double dp = 0.001;
    const double mirrored = Whole(askew_rings(dp, 0)).measured("rebound_ratio");
    for (const double across : {1e-9, 0.25 * dp}) {
      CAPTURE(across);
      const Whole askew(askew_rings(dp, across));
      CHECK(askew.measured("mirror_asymmetry") > 0);
      CHECK(std::abs(askew.measured("rebound_ratio") / mirrored - 1) < 0.001);
    }
  }

  TEST_CASE("colliding rings: the contact of oenog never pulls") {
    // a push never increases the left ring's velocity
    for (const double spacing : {0.002, 0.001}) {
      const Whole rings(scene("colliding-rings", spacing));
      const std::vector<double>& speed = rings.probe("speed");
      double pulled = 0;
      for (std::size_t k = 1; k < speed.size(); ++k) pulled = std::max(pulled, speed[k] - speed[k - 1]);
      CHECK(pulled < 1e-12 * speed.front());
      CHECK(speed.back() < -0.7 * speed.front());
    }
  }
}

TEST_SUITE("failure") {
  TEST_CASE(
      "colliding rings: at 0.14 c0 oenog and pf-jst stay intact, and in tl faces penetrate each other") {
    const auto fast = [](const char* method, double spacing) {
      return judged(scene("colliding-rings", spacing, {{"v0", "0.14"}}, method));
    };
    CHECK(name(fast("oenog", 0.002).verdict()) == "stable");
    CHECK(name(fast("oenog", 0.001).verdict()) == "stable");
    CHECK(fast("pf-jst", 0.001).verdict() < Verdict::penetrated);
    const Judge tl = fast("tl", 0.001);
    REQUIRE(tl.since().contains(Verdict::penetrated));
    CHECK(std::abs(tl.since().at(Verdict::penetrated) - 4.05e-3) < 0.1e-3);
  }

  TEST_CASE("colliding rings: at 0.1 c0 the rings rebound with oenog, and hardly with enog") {
    const auto rebound = [](const char* method) {
      return Whole(scene("colliding-rings", 0.002, {{"v0", "0.1"}}, method)).measured("rebound_ratio");
    };
    CHECK(rebound("oenog") == relative(0.784, 0.01));
    CHECK(rebound("enog") < 0.3);
  }

  TEST_CASE(
      "colliding rings: with oenog at 0.16 c0 and 0.8 mm the sides of the crease do not penetrate each other") {
    SceneFile file = scene("colliding-rings", 0.0008, {{"v0", "0.16"}});
    file.scene.until = 0.005;  // the crease is sharpest at 4 ms
    CHECK(name(judged(file).verdict()) == "stable");
  }

  TEST_CASE(
      "colliding rings: at 0.16 c0 and 1.25 mm pf-jst and pfj-jst survive the crease with a short kernel or dissipation") {
    const auto fastest = [](const char* method, const char* h, const char* eps,
                            const char* contact = "surface") {
      SceneFile file =
          scene("colliding-rings", 0.00125,
                {{"v0", "0.16"}, {"method.h", h}, {"method.eps_v2", eps}, {"contact", contact}}, method);
      file.scene.until = 0.005;  // the crease is sharpest at 4.1 ms
      return judged(file);
    };
    for (const char* method : {"pf-jst", "pfj-jst"}) {
      CAPTURE(std::string(method));
      CHECK(fastest(method, "0.8", "0").verdict() < Verdict::penetrated);
      CHECK(name(fastest(method, "0.8", "0.125").verdict()) == "stable");
      CHECK(name(fastest(method, "1.05", "0.125").verdict()) == "stable");
    }
    CHECK(name(fastest("pf-jst", "1.05", "0", "penalty").verdict()) == "penetrated");
  }
}

}  // namespace of_this_file
