#include <algorithm>
#include <array>
#include <ostream>
#include <string_view>

#include <CLI/CLI.hpp>

#include "cli/command_line/command.hpp"
#include "cli/run/plan.hpp"
#include "cli/run/report.hpp"
#include "cli/run/resume.hpp"
#include "cli/text/checks.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct Options : RunOptions {
  std::optional<std::string> fail_on;
  std::optional<double> checkpoint_every;
  std::optional<std::string> resume;
  bool quiet = false;
};

void declare_options(CLI::App& app, Options& o) {
  app.add_option("SCENE", o.scene, "a name from `taut list scenes`, or the path of a scene file")
      ->option_text(" ");
  declare_setting_options(app, o);
  app.add_option("--out", o.out, "the run folder; default: out/SCENE-METHOD. An older run in it is replaced")
      ->option_text("DIR");
  declare_output_options(app, o);
  declare_particle_options(app, o);
  app.add_option("--checkpoint-every", o.checkpoint_every,
                 "simulated time, s, between checkpoints for --resume; one more when interrupted")
      ->option_text("T")
      ->check(positive_number);
  app.add_option(
         "--resume", o.resume,
         "goes on with the run in this folder from its last checkpoint, to the same bytes as without a "
         "stop; only --threads, --fail-on, --quiet may be given with it")
      ->option_text("DIR");
  app.add_option("--threads", o.threads, "default: all cores")
      ->option_text("N")
      ->check(positive_whole_number);
  app.add_flag("--no-render", o.no_render, "no frames");
  app.add_option("--fail-on", o.fail_on, "exit code 3 if the verdict is this one or worse")
      ->option_text("VERDICT");
  app.add_flag("--quiet", o.quiet, "no progress on stderr");
}

/// Everything else stands in the folder.
void refuse_beside_resume(const CLI::App& app) {
  constexpr std::array<std::string_view, 4> allowed = {"--resume", "--threads", "--fail-on", "--quiet"};
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 && std::ranges::find(allowed, name) == allowed.end())
      throw UsageError("--resume goes on as the scene.toml of the folder says: " + name +
                       " cannot be given with it");
  }
}

RunPlan planned(const Options& options, const CLI::App& app) {
  if (options.resume) {
    refuse_beside_resume(app);
    return resume_plan(*options.resume, options.threads);
  }
  if (options.scene.empty()) throw UsageError("SCENE is required; see `taut run --help`");
  RunPlan plan = make_plan(options);
  plan.checkpoint_every = options.checkpoint_every;
  return plan;
}

int run(const Options& options, const CLI::App& app, Streams streams) {
  const Stopwatch setup;
  const std::optional<Verdict> fail_on = parse_verdict(options.fail_on);
  const RunPlan plan = planned(options, app);
  const Interrupts interrupts;
  Progress progress(streams.err, progress_style(streams.err, options.quiet));
  const RunResult result = run_scene(plan, interrupts, progress, setup.seconds());
  streams.out << run_report(plan, result);
  if (!result.failure.empty()) streams.err << "taut: " << result.failure << '\n';
  return exit_code(result, fail_on);
}

}  // namespace

std::function<int(Streams)> declare_run(CLI::App& app) {
  auto options = std::make_shared<Options>();
  declare_options(app, *options);
  return [options, &app](Streams streams) { return run(*options, app, streams); };
}

}  // namespace taut::cli
