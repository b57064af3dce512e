#include <cmath>
#include <map>
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
#include "engine/diagnostics/verdict.hpp"
#include "engine/families/catalogue.hpp"
#include "engine/simulation.hpp"

using namespace taut;
using namespace taut::cli;

/// The scenes in three dimensions, in their quick versions, against their own references.
namespace {

struct Run {
  std::map<std::string, MeasureResult> measure;
  Verdict verdict = Verdict::stable;
  Readings last{};
  int pieces = 0;

  double error(const std::string& name) const {
    const MeasureResult& result = measure.at(name);
    INFO(name);
    REQUIRE(result.value);
    REQUIRE(result.error);
    return *result.error;
  }
};

Run run(const std::string& name, const std::string& method, std::vector<Setting> settings) {
  settings.push_back({"method", method});
  SceneFile file = read_scene(find_scene(name), settings);
  file.settings.threads = 1;
  const auto simulation = make_simulation(file.scene, file.settings);
  Judge judge(file.scene, simulation->snapshot(), simulation->support());
  IndicatorGauge gauge(file.scene, simulation->snapshot());
  Run run;
  constexpr int looks = 20;
  for (int k = 1; k <= looks; ++k) {
    simulation->advance_to(file.scene.until * k / looks);
    const Snapshot& now = simulation->snapshot();
    run.last = gauge(now);
    judge.observe(now, balance(now, file.scene), run.last);
  }
  run.verdict = judge.verdict();
  run.pieces = judge.pieces();
  const std::string_view law = material_law(*find_method(method), file.settings, 3);
  for (const MeasureResult& result : measure(file.scene, simulation->series(), law))
    run.measure[result.name] = result;
  return run;
}

/// A quarter of the published area.
Run small_plate(const std::string& method) { return run("oscillating-plate-3d", method, {{"side", "0.2"}}); }

}  // namespace
