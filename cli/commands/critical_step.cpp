#include "engine/diagnostics/critical_step.hpp"

#include <memory>
#include <ostream>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/run/plan.hpp"
#include "cli/run/report.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "cli/text/json.hpp"
#include "engine/diagnostics/step_limits.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct CriticalStepArguments : RunOptions {
  int steps = CriticalStepSearch().steps;
  double tolerance = CriticalStepSearch().tolerance;
  bool json = false, quiet = false;
};

std::string bracket(const CriticalStep& found) {
  if (!found.stable) return found.unstable ? fmt::format("unstable at {} s", brief(*found.unstable)) : "";
  return fmt::format("{} s{}", brief(*found.stable),
                     found.unstable ? fmt::format(" to {} s", brief(*found.unstable)) : " or more");
}

CriticalStep search(const SceneFile& file, const CriticalStepArguments& options, Progress& progress) {
  constexpr double usual_trials = 12;
  const Interrupts interrupts;
  const auto goes_on = [&](const CriticalStep& so_far) {
    progress.show(so_far.trials / (so_far.trials + usual_trials), bracket(so_far));
    return !interrupts.interrupted();
  };
  progress.begin("critical step");
  try {
    const CriticalStep found =
        find_critical_step(file.scene, file.settings, {options.steps, options.tolerance}, goes_on);
    progress.end(std::to_string(found.trials) + " trials");
    return found;
  } catch (const SceneError& error) {
    throw locate(file, error);
  } catch (const NumericalError& error) {  // in the step that determines the default step
    throw NumericalError(error.step, error.time, error.particle, error.field, describe_divergence(error));
  }
}

std::string result_text(const SceneFile& file, const CriticalStep& found) {
  std::string text = fmt::format("{} with {} at dp = {} m\n", file.scene.name, file.settings.method,
                                 brief(file.scene.spacing));
  std::vector<std::vector<std::string>> rows;
  if (found.stable) {
    const double share = *found.stable / found.default_step;
    rows.push_back({"largest stable step", brief(*found.stable) + " s",
                    found.unstable ? fmt::format("unstable at {} s", brief(*found.unstable))
                                   : "the largest step tried"});
    rows.push_back({"over the default step", brief(share),
                    fmt::format("default: {} s; CFL number found: {}", brief(found.default_step),
                                brief(share * file.settings.cfl))});
  } else {
    rows.push_back({"largest stable step", "none", found.unstable ? bracket(found) : ""});
    rows.push_back({"default step", brief(found.default_step) + " s", ""});
  }
  for (const StepLimit& limit : step_limits(file.scene, file.settings)) {
    const std::string ratio =
        found.stable ? fmt::format("found: {} of this limit; ", brief(*found.stable / limit.step)) : "";
    rows.push_back({std::string(limit.name), brief(limit.step) + " s", ratio + std::string(limit.source)});
  }
  rows.push_back({"time of a trial", brief(found.covered) + " s, at least 300 steps",
                  std::to_string(found.trials) + " trials"});
  if (found.interrupted)
    rows.push_back({"interrupted", "", "the search is incomplete; run the command again for closer bounds"});
  return text + in_columns(rows);
}

Json result_json(const SceneFile& file, const CriticalStep& found) {
  Json limits = Json::array();
  for (const StepLimit& limit : step_limits(file.scene, file.settings))
    limits.add({{"name", limit.name}, {"source", limit.source}, {"step", limit.step}});
  Json json{{"scene", file.scene.name}, {"method", file.settings.method}, {"spacing", file.scene.spacing}};
  json["unit"] = "s";
  json["critical_step"] = found.stable;
  json["unstable_step"] = found.unstable;
  json["default_step"] = found.default_step;
  json["over_default"] = found.stable ? Json(*found.stable / found.default_step) : Json();
  json["covered"] = found.covered;
  json["trials"] = found.trials;
  json["interrupted"] = found.interrupted;
  json["limits"] = limits;
  return json;
}

int find(const CriticalStepArguments& options, Streams streams) {
  const SceneFile file = scene_to_run(options);
  print_remark(file, streams.err);
  Progress progress(streams.err, progress_style(streams.err, options.quiet));
  const CriticalStep found = search(file, options, progress);
  if (options.json)
    streams.out << result_json(file, found).dump(2) << '\n';
  else
    streams.out << result_text(file, found);
  return found.interrupted ? Interrupts::exit_code() : exit_fine;
}

std::string tolerance_in_bounds(const std::string& text) {
  const auto value = parsed<double>(text);
  return value && *value >= 1e-9 && *value <= 0.5
             ? ""
             : fmt::format("'{}' must be a number from 1e-9 to 0.5", text);
}

}  // namespace

std::function<int(Streams)> declare_critical_step(Options& command) {
  auto options = std::make_shared<CriticalStepArguments>();
  command.add_argument("SCENE", options->scene, "a name from `taut list scenes`, or the path of a scene file")
      .required();
  declare_setting_options(command, *options);
  command
      .add("--steps", "N", options->steps,
           "length of a trial, in default time steps; at most the length of the scene; "
           "a trial always makes at least 300 steps of its own; default: " +
               std::to_string(options->steps))
      .check(positive_whole_number);
  command
      .add(
          "--tolerance", "X", options->tolerance,
          "largest relative distance between the stable and the unstable step found, 1e-9 to 0.5; default: " +
              brief(options->tolerance))
      .check(tolerance_in_bounds);
  command
      .add("--threads", "N", options->threads,
           "number of threads; default: all cores, fewer for small scenes")
      .check(positive_whole_number);
  command.add_flag("--json", options->json, "print JSON, for scripts");
  command.add_flag("--quiet", options->quiet, "print no progress on stderr");
  return [options](Streams streams) { return find(*options, streams); };
}

}  // namespace taut::cli
