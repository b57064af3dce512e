#include <map>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/indicators.hpp"
#include "engine/judge/verdict.hpp"
#include "engine/simulation.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::cli;

namespace {

/// A published statement. Scenes are coarser than in the paper where this does not change the verdict.
struct Statement {
  const char* figure;
  const char* scene;
  const char* method;
  std::map<std::string, std::string> set;
  double until;
  Verdict published;
  /// Verdict here, if it differs.
  std::optional<Verdict> here = {};
};

constexpr Verdict stable = Verdict::stable, hourglass = Verdict::hourglass, fractured = Verdict::fractured,
                  diverged = Verdict::diverged;

/// `until` is long enough for the failure to appear; a stable run does not fail until then.
const std::vector<Statement> statements = {
    {"Zhang2024 Fig. 3(a)", "oscillating-plate", "og", {}, 0.05, fractured},
    {"Zhang2024 Fig. 3(b)", "oscillating-plate", "oas", {}, 0.05, hourglass},
    {"Zhang2024 Fig. 3(c)", "oscillating-plate", "enog", {}, 0.1, stable},
    {"Zhang2024 Fig. 6(a)", "oscillating-plate", "og", {}, 0.012, hourglass},
    {"Zhang2024 Fig. 12 left", "colliding-rings", "og", {}, 0.0025, fractured},
    {"Zhang2024 Fig. 12 middle", "colliding-rings", "oas", {{"spacing", "0.002"}}, 0.005, hourglass},
    {"Zhang2024 Fig. 12 right", "colliding-rings", "enog", {{"spacing", "0.002"}}, 0.012, stable},
    {"Zhang2024 Fig. 13 left",
     "colliding-rings",
     "oas",
     {{"v0", "0.07"}, {"spacing", "0.002"}},
     0.005,
     hourglass},
    {"Zhang2024 Fig. 13 right",
     "colliding-rings",
     "enog",
     {{"v0", "0.07"}, {"spacing", "0.002"}},
     0.012,
     stable},
    {"Zhang2024 Fig. 14 left", "colliding-rings", "oas", {{"v0", "0.08"}}, 0.006, fractured},
    {"Zhang2024 Fig. 14 right",
     "colliding-rings",
     "enog",
     {{"v0", "0.08"}, {"spacing", "0.002"}},
     0.012,
     stable},
    {"Zhang2024 Fig. 18(a)", "ball-plate", "og", {}, 0.011, fractured},
    {"Zhang2024 Fig. 18(b)", "ball-plate", "oas", {}, 0.014, hourglass},
    {"Zhang2024 Fig. 18(c)", "ball-plate", "enog", {}, 0.04, stable},
    // in the paper it fractures from 0.012 s; here it zigzags (hourglass_error 0.17) but does not fracture
    {"Zhang2024 Fig. 19(a)", "ball-plate", "oas", {{"v0", "0.06"}}, 0.02, fractured, hourglass},
    {"Zhang2024 Fig. 19(b)", "ball-plate", "enog", {{"v0", "0.06"}}, 0.04, stable},
    // smooth as published, but the energy exceeds twice the received energy
    {"Zhang2024 Fig. 20", "ball-plate", "enog", {{"v0", "0.12"}}, 0.04, stable, diverged},

    // coarser than in the paper: 4 particles across the walls of the balls, 3 across the plates
    {"Zhang2024 Fig. 9", "oscillating-plate-3d", "enog", {{"side", "0.2"}}, 0.01, stable},
    {"Zhang2024 Fig. 16", "colliding-balls", "enog", {{"spacing", "0.0025"}}, 0.007, stable},
    {"Zhang2024 Fig. 21", "ball-plate-3d", "enog", {{"spacing", "0.0066667"}}, 0.015, stable},

    {"Khayyer2024 Fig. 9", "rotating-plate", "d-ulsph-r-tic", {}, 0.15, stable},
    // just stable with ∇u at mid-step; with ∇u at the start of the step, as printed, it zigzags
    {"Khayyer2024 Fig. 9, (0.15, 8)", "rotating-plate", "d-ulsph-r-as", {}, 0.15, hourglass, stable},
    {"Khayyer2024 Fig. 9, (0.15, 8), as printed",
     "rotating-plate",
     "d-ulsph-r-as",
     {{"method.geometry", "0"}, {"cfl", "0.25"}},
     0.15,
     hourglass},
    {"Khayyer2024 Fig. 9, as printed",
     "rotating-plate",
     "d-ulsph-r-tic",
     {{"method.geometry", "0"}, {"cfl", "0.25"}},
     0.15,
     stable},
    {"Khayyer2024 Fig. 9, (0.15, 2.55)",
     "rotating-plate",
     "d-ulsph-r-as",
     {{"method.exponent", "2.55"}},
     0.08,
     hourglass},
    {"Khayyer2024 Fig. 9, (0.3, 4)",
     "rotating-plate",
     "d-ulsph-r-as",
     {{"method.epsilon", "0.3"}, {"method.exponent", "4"}},
     0.15,
     hourglass},
    {"Khayyer2024 Fig. 9, (0.5, 8)",
     "rotating-plate",
     "d-ulsph-r-as",
     {{"method.epsilon", "0.5"}},
     0.15,
     hourglass},
    {"Khayyer2024 Fig. 10", "rotating-plate", "d-ulsph-r-as", {{"spacing", "0.02"}}, 0.1, hourglass},
    {"Khayyer2024 Fig. 10", "rotating-plate", "d-ulsph-r-tic", {{"spacing", "0.02"}}, 0.1, stable},
    {"Khayyer2024 Fig. 13(a)",
     "rotating-plate",
     "d-ulsph-r-tic",
     {{"method.surface_artificial_stress", "0"}},
     0.15,
     hourglass},

    // the figure shows the tensile cube; at a spacing of 40 mm the hourglass error of tl reaches only 0.96 of the
    // threshold
    {"Lee2016 Fig. 11(a)", "rotating-plate", "tl", {{"spacing", "0.0333333333"}}, 0.1, hourglass},
    {"Lee2016 Fig. 11(b)", "rotating-plate", "pf-jst", {}, 0.2, stable},
    {"Lee2016 Fig. 11(c)", "rotating-plate", "pfj-jst", {}, 0.2, stable},
};

Verdict verdict_of(const Statement& statement) {
  std::vector<Setting> settings{{"method", statement.method}, {"until", exact(statement.until)}};
  for (const auto& [name, value] : statement.set) settings.push_back({name, value});
  SceneFile file = read_scene(find_scene(statement.scene), settings);
  file.settings.threads = 1;
  const auto simulation = make_simulation(file.scene, file.settings);
  Judge judge(file.scene, *simulation);
  IndicatorGauge gauge(file.scene, simulation->snapshot());
  constexpr int looks = 40;
  for (int k = 1; k <= looks && judge.verdict() != diverged; ++k) {
    simulation->advance_to(file.scene.until * k / looks);
    const Snapshot& now = simulation->snapshot();
    judge.observe(now, balance(now, file.scene), gauge(now));
  }
  return judge.verdict();
}

void check(const std::string& scene) {
  for (const Statement& statement : statements) {
    if (statement.scene != scene) continue;
    CAPTURE(std::string(statement.figure));
    CAPTURE(std::string(statement.method));
    CHECK(name(verdict_of(statement)) == name(statement.here.value_or(statement.published)));
  }
}

}  // namespace

TEST_SUITE("failure") {
  TEST_CASE("published statements about the oscillating plate hold as recorded") {
    check("oscillating-plate");
  }
  TEST_CASE("published statements about the colliding rings hold as recorded") { check("colliding-rings"); }
  TEST_CASE("published statements about ball and plate hold as recorded") { check("ball-plate"); }
  TEST_CASE("published statements about the scenes in 3D hold as recorded") {
    for (const char* scene : {"oscillating-plate-3d", "colliding-balls", "ball-plate-3d"}) check(scene);
  }
  TEST_CASE("published statements about the rotating plate hold as recorded") { check("rotating-plate"); }

  TEST_CASE("impacts: tl zigzags and fractures where tl-hg and tl-enog are stable") {
    const auto verdict = [](const char* scene, const char* method, const char* v0, double until) {
      CAPTURE(std::string(scene));
      CAPTURE(std::string(method));
      return std::string(name(verdict_of({"", scene, method, {{"v0", v0}}, until, stable})));
    };
    CHECK(verdict("ball-plate", "tl", "0.06", 0.006) == name(hourglass));
    CHECK(verdict("ball-plate", "tl", "0.06", 0.02) == name(fractured));
    CHECK(verdict("colliding-rings", "tl", "0.12", 0.006) == name(fractured));
    for (const char* method : {"tl-hg", "tl-enog"}) {
      CHECK(verdict("ball-plate", method, "0.06", 0.04) == name(stable));
      CHECK(verdict("colliding-rings", method, "0.06", 0.012) == name(stable));
      CHECK(verdict("colliding-rings", method, "0.12", 0.012) == name(stable));
    }
  }
}

}  // namespace of_this_file
