#include <ostream>

#include <CLI/CLI.hpp>

#include "cli/command.hpp"
#include "cli/option_checks.hpp"
#include "cli/run_options.hpp"
#include "cli/run_report.hpp"

namespace taut {
namespace {

struct Options : RunOptions {
  std::optional<std::string> fail_on;
  bool quiet = false;
};

void declare_options(CLI::App& app, Options& o) {
  app.add_option("SCENE", o.scene, "a name from `taut list scenes`, or the path of a scene file")
      ->option_text(" ")
      ->required();
  declare_setting_options(app, o);
  app.add_option("--out", o.out, "the run folder; default: out/SCENE-METHOD. An older run in it is replaced")
      ->option_text("DIR");
  declare_output_options(app, o);
  declare_particle_options(app, o);
  app.add_option("--threads", o.threads, "default: all cores")
      ->option_text("N")
      ->check(positive_whole_number);
  app.add_flag("--no-render", o.no_render, "no frames");
  app.add_option("--fail-on", o.fail_on, "exit code 3 if the verdict is this one or worse")
      ->option_text("VERDICT");
  app.add_flag("--quiet", o.quiet, "no progress on stderr");
}

int run(const Options& options, Streams streams) {
  const Stopwatch setup;
  const std::optional<Verdict> fail_on = parse_verdict(options.fail_on);
  const RunPlan plan = make_plan(options);
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
  return [options](Streams streams) { return run(*options, streams); };
}

}  // namespace taut
