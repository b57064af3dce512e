#include <cmath>
#include <ostream>

#include <CLI/CLI.hpp>

#include "cli/command.hpp"
#include "cli/exit_code.hpp"
#include "cli/option_checks.hpp"
#include "cli/output_times.hpp"
#include "cli/run.hpp"
#include "cli/run_report.hpp"
#include "cli/text.hpp"
#include "cli/unknown_name.hpp"
#include "engine/error.hpp"
#include "engine/method_info.hpp"

namespace taut {
namespace {

constexpr int default_history_rows = 1000;

struct Options {
  std::string scene;
  std::optional<std::string> method, out, fail_on;
  std::vector<std::string> set;
  std::optional<double> spacing, until, every, history;
  std::optional<int> frames;
  DrawingOptions drawing;
  int threads = 0;
  bool no_render = false, quiet = false;
};

void declare_options(CLI::App& app, Options& o) {
  app.add_option("SCENE", o.scene, "a name from `taut list scenes`, or the path of a scene file")
      ->option_text(" ")
      ->required();
  app.add_option("--method", o.method, "`taut list methods`; default: the scene's")->option_text("NAME");
  app.add_option("--set", o.set, "a parameter of the scene, or method.NAME: a constant of the method")
      ->option_text("NAME=VALUE ...")
      ->allow_extra_args(false)
      ->check(assignment);
  app.add_option("--spacing", o.spacing, "of the particles, m; rounded so that it divides the first body")
      ->option_text("DP")
      ->check(positive_number);
  app.add_option("--until", o.until, "end of the run, s")->option_text("T")->check(positive_number);
  app.add_option("--out", o.out, "the run folder; default: out/SCENE-METHOD. An older run in it is replaced")
      ->option_text("DIR");
  auto* frames = app.add_option("--frames", o.frames, "frames after the one at t = 0, evenly spaced")
                     ->option_text("N")
                     ->check(positive_whole_number);
  app.add_option("--every", o.every, "time between frames, s; rounded so that the last one shows the end")
      ->option_text("DT")
      ->check(positive_number)
      ->excludes(frames);
  app.add_option("--history", o.history,
                 "time between rows of history.csv, s; default: a thousandth of the run")
      ->option_text("DT")
      ->check(positive_number);
  declare_drawing_options(app, o.drawing);
  app.add_option("--threads", o.threads, "default: all cores")
      ->option_text("N")
      ->check(positive_whole_number);
  app.add_flag("--no-render", o.no_render, "no frames");
  app.add_option("--fail-on", o.fail_on, "exit code 3 if the verdict is this one or worse")
      ->option_text("VERDICT");
  app.add_flag("--quiet", o.quiet, "no progress on stderr");
}

std::optional<Verdict> parse_verdict(const std::optional<std::string>& text) {
  if (!text) return std::nullopt;
  std::vector<std::string> names;
  for (int v = static_cast<int>(Verdict::stable) + 1; v <= static_cast<int>(Verdict::diverged); ++v) {
    if (name(static_cast<Verdict>(v)) == *text) return static_cast<Verdict>(v);
    names.emplace_back(name(static_cast<Verdict>(v)));
  }
  throw UsageError(unknown_name("verdict", *text, names));
}

Overrides overrides(const Options& options) {
  Overrides result;
  for (const std::string& text : options.set) {
    const std::size_t at = text.find('=');
    result.set.emplace_back(text.substr(0, at), text.substr(at + 1));
  }
  result.method = options.method;
  result.spacing = options.spacing;
  result.until = options.until;
  return result;
}

void check_method(const std::optional<std::string>& given) {
  if (!given || find_method(*given)) return;
  std::vector<std::string> names;
  for (const MethodInfo& m : methods()) names.emplace_back(m.name);
  throw UsageError(unknown_name("method", *given, names));
}

int frame_count(const Options& options, const SceneFile& file) {
  constexpr double most = 1e6;
  const double count = options.frames  ? *options.frames
                       : options.every ? std::fmax(1, std::round(file.scene.until / *options.every))
                                       : file.drawing.frames;
  if (count > most)
    throw UsageError("that makes more than a million frames; take fewer --frames or a longer --every");
  return static_cast<int>(count);
}

double history_interval(const Options& options, const SceneFile& file) {
  constexpr double most_rows = 1e7;
  const double interval =
      options.history.value_or(file.history.value_or(file.scene.until / default_history_rows));
  if (file.scene.until / interval > most_rows)
    throw UsageError("--history " + brief(interval) + " makes more than 10 million rows; take a longer one");
  return interval;
}

/// Reads and checks all there is to check.
RunPlan make_plan(const Options& options) {
  check_method(options.method);
  RunPlan plan;
  SceneFile& file = plan.file;
  file = read_scene(find_scene(options.scene), overrides(options));
  file.settings.threads = options.threads;
  file.drawing = with_options(file.drawing, options.drawing);
  file.drawing.frames = frame_count(options, file);
  file.history = history_interval(options, file);
  file.resolved = resolved_text(file);
  plan.spacing_asked = options.spacing;
  const DrawingPlan drawing = plan_drawing(file.drawing);
  if (!options.no_render) {
    plan.drawing = drawing;
    plan.frame_times = times_in_parts(file.scene.until, file.drawing.frames);
  }
  plan.history_times = times_every(file.scene.until, *file.history);
  plan.folder = RunFolder(options.out.value_or("out/" + file.scene.name + "-" + file.settings.method));
  plan.folder.check();
  return plan;
}

int exit_code(const RunResult& result, const std::optional<Verdict>& fail_on) {
  if (!result.failure.empty()) return exit_diverged;
  if (result.record.status == RunRecord::Status::interrupted) return exit_interrupted;
  return fail_on && result.record.verdict >= *fail_on ? exit_diverged : exit_fine;
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
