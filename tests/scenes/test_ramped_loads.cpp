#include <fstream>
#include <vector>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/judge/verdict.hpp"
#include "engine/simulation.hpp"
#include "tests/support/files.hpp"
#include "tests/support/runs.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

/// The load, a traction or the weight, grows from 0 during T: the first energies are near round-off.
constexpr const char* beam = R"(
title = "Beam at rest under a ramped load"
spacing = "0.002"
until = 0.3
damping = 100
[parameters]
load = { value = 137.4, help = "traction in Pa, or gravity in m/s²" }
T = { value = 0.05, unit = "s" }
[material.rubber]
density = 1000
youngs_modulus = 1e7
poisson_ratio = 0.3
[[body]]
name = "beam"
shape = { type = "rectangle", low = ["-4*dp", -0.01], high = [0.2, 0.01] }
material = "rubber"
held = "x < 0"
)";
const std::string traction =
    "loaded = [{ where = \"x > 0.1 && y > 0.01 - dp\", traction = [0, \"-load\"], ramp = \"t < T ? t/T : 1\" }]\n";
const std::string weight = "gravity = [0, \"-load*min(t/T, 1)\"]\n";

class Beam {
 public:
  explicit Beam(const std::string& load) {
    std::ofstream(folder_ / "beam.toml") << (load == weight ? load + beam : beam + load);
  }
  Verdict verdict(const std::vector<Setting>& settings, double until = 2e-4, int each = 1) const {
    SceneFile file = read_scene(folder_ / "beam.toml", settings);
    file.settings.threads = 1;
    const auto simulation = make_simulation(file.scene, file.settings);
    Judge judge(file.scene, *simulation);
    while (simulation->time() < until) {
      make_steps(*simulation, each);
      judge.observe(simulation->snapshot(), balance(simulation->snapshot(), file.scene));
    }
    return judge.verdict();
  }

 private:
  TemporaryFolder folder_;
};

void check_stable(const Beam& beam, const std::vector<double>& loads) {
  for (const std::string method : {"oenog", "tl"})
    for (const double load : loads)
      for (int k = 1; k <= 20; ++k) {
        CAPTURE(method);
        CAPTURE(load);
        CAPTURE(k);
        CHECK(beam.verdict({{"method", method}, {"load", exact(load)}, {"T", exact(0.01 * k)}}) ==
              Verdict::stable);
      }
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("verdict: a body at rest under a load that grows from zero is stable from the first step on") {
    check_stable(Beam(traction), {50, 137.4, 500, 2000});
  }

  TEST_CASE("verdict: a body at rest under a weight that grows from zero is stable from the first step on") {
    check_stable(Beam(weight), {1, 9.81, 100});
  }

  TEST_CASE("verdict: the verdict of a body at rest does not depend on how often it is observed") {
    const Beam loaded(traction);
    for (const int each : {1, 2, 3, 5, 8, 13})
      CHECK(loaded.verdict({{"method", "tl"}, {"T", "0.15"}}, 2e-3, each) == Verdict::stable);
  }
}

}  // namespace of_this_file
