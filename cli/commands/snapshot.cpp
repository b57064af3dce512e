#include <algorithm>
#include <filesystem>
#include <ostream>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/report_options.hpp"
#include "cli/run/baseline.hpp"
#include "cli/run/frame_folders.hpp"
#include "cli/run/plan.hpp"
#include "cli/run/report.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/sweep/runner.hpp"
#include "cli/sweep/suite_tables.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/folder_lock.hpp"
#include "cli/system/terminal_columns.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/suggest.hpp"
#include "engine/core/machine.hpp"
#include "engine/error.hpp"
#include "render/image/png.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct SnapshotArguments : RunOptions, DifferenceOptions, ReportOptions {
  std::optional<std::string> baseline;
  std::vector<std::string> only;
  std::optional<int> jobs;
  bool update = false, list = false, quiet = false;
};

void declare_options(Options& command, SnapshotArguments& o) {
  command
      .add_argument("SCENE|SUITE", o.scene,
                    "a name from `taut list scenes`, or the path of a scene file; "
                    "or a suite: the path of a suite file (`taut describe suite-file`), "
                    "or its name in scenes/suites/")
      .required();
  command.add("--baseline", "DIR", o.baseline,
              "folder of the frames to compare with, or of all baselines of a suite; "
              "default for a suite: `baselines` of its file, else its name without .toml");
  command.add_flag("--update", o.update, "replace the baseline by the frames of this run");
  command
      .add("--only", "ENTRY,...", o.only,
           "for a suite: entries to run; with --update: entries whose baselines are renewed")
      .comma_separated();
  command.add_flag("--list", o.list, "for a suite: list the entries; run nothing");
  command
      .add("--jobs", "N", o.jobs,
           "for a suite: number of runs at a time; default: cores divided by --threads")
      .check(positive_whole_number);
  declare_difference_options(command, o);
  declare_setting_options(command, o);
  command.add(
      "--out", "DIR", o.out,
      "run folder; default: out/snapshot-BASELINE; for a suite: out/snapshot-SUITE, with a run in each subfolder");
  declare_output_options(command, o);
  command
      .add("--threads", "N", o.threads,
           "number of threads; default: all cores, fewer for small scenes; for each run of a suite: 1")
      .check(positive_whole_number);
  o.declare_json(command);
  o.declare_junit(command);
  command.add_flag("--quiet", o.quiet, "print no progress on stderr");
}

struct Result {
  int code = exit_fine;
  std::string text;
  Json json = json_answer("snapshot");
  std::vector<TestCase> cases;
  std::string worst;
};

void update(const Baseline& baseline, const RunFolder& run, Result& result) {
  for (const std::string& name : picture_names(run.frames())) result.cases.push_back({name});
  result.text =
      "baseline " + baseline.path().string() + ": " + std::to_string(baseline.replace_by(run)) + " frames\n";
}

void compare_with_baseline(const SnapshotArguments& options, const fs::path& baseline, const RunFolder& run,
                           Result& result) {
  const std::string frames = run.frames().string();
  const FolderDifference difference = compare_folders(baseline, frames, limit_of(options));
  result.text = difference_report(difference, baseline.string(), frames);
  result.json["pictures"] = pictures_json(difference);
  result.cases = test_cases(difference, baseline.string(), frames);
  if (difference.alike()) return;
  result.code = exit_different;
  if (difference.different() == 0) return;
  result.worst = difference.worst;
  result.json["difference"] = run.difference().string();
  result.text += "  picture of the differences: " + run.difference().string() + "\n";
}

int snapshot_of_scene(SnapshotArguments options, Streams streams) {
  const Stopwatch setup;
  if (!options.baseline) {
    if (const std::string near = did_you_mean(options.scene, suite_names()); !near.empty())
      throw UsageError(fmt::format("there is no suite '{}'{}", options.scene, near));
    throw UsageError("--baseline is required: the folder of the frames to compare with");
  }
  const Baseline baseline(*options.baseline);
  if (!options.out) {
    options.out = "out/snapshot-" + plain_path(baseline.path()).filename().string();
    options.out_named = false;
  }
  options.keeps_look = options.update;
  if (!options.update) options.look = baseline.look();
  const RunPlan plan = make_plan(options);
  print_remark(plan.file, streams.err);
  baseline.check(plan.folder.path(), options.update);
  if (!options.update && !baseline.exists())
    throw UsageError("there is no baseline in '" + *options.baseline +
                     "'; create it from this run with --update");
  const FolderLock lock(plan.folder.path(), FolderLock::Of::run, "taut snapshot", streams.err);
  plan.folder.check();  // the folder may have changed
  const Interrupts interrupts;
  Progress progress(streams.err, progress_style(streams.err, options.quiet));
  const RunResult run = run_scene(plan, interrupts, progress, setup.seconds());
  if (!run.failure.empty()) streams.err << "taut: " << run.failure << '\n';
  Result result;
  result.code = exit_code(run);
  result.json["run"] = plan.folder.path().string();
  result.json["baseline"] = *options.baseline;
  result.json["updated"] = options.update && result.code == exit_fine;
  result.json["pictures"] = Json::array();
  if (result.code != exit_fine)
    result.cases = {{"run", TestCase::Result::error, run.failure.empty() ? "interrupted" : run.failure}};
  else if (options.update)
    update(baseline, plan.folder, result);
  else
    compare_with_baseline(options, baseline.path(), plan.folder, result);
  result.json["passed"] = result.code == exit_fine;
  streams.out << (options.json ? result.json.dump(2) + "\n" : result.text);
  options.publish({"snapshot", *options.baseline, result.cases}, streams.err);
  if (!result.worst.empty())
    render::write_png(render::difference_picture(render::read_png(baseline.path() / result.worst),
                                                 render::read_png(plan.folder.frames() / result.worst)),
                      plan.folder.difference());
  return result.code;
}

/// nullopt if `what` is taken for a scene.
std::optional<fs::path> suite_of(const std::string& what) {
  std::error_code error;
  if (fs::is_regular_file(what, error))
    return is_suite_file(what) ? std::optional<fs::path>(what) : std::nullopt;
  if (fs::exists(what, error)) return std::nullopt;
  const std::optional<fs::path> suite = shipped_suite(what);
  if (!suite) return std::nullopt;
  const std::vector<std::string> scenes = scene_names();
  return std::ranges::find(scenes, what) == scenes.end() ? suite : std::nullopt;
}

void check_options(const Options& command, bool suite) {
  static const std::vector<std::string> of_suites = {"--only", "--list", "--jobs"},
                                        of_both = {"--baseline", "--update", "--out",   "--threads",
                                                   "--json",     "--junit",  "--quiet", "--help"};
  const auto in = [](const std::vector<std::string>& names, const Option& option) {
    return std::ranges::any_of(names, [&](const std::string& name) { return option.has_name(name); });
  };
  for (const Option& option : command.all()) {
    if (option.is_positional() || option.values().empty() || in(of_both, option)) continue;
    if (!suite && in(of_suites, option))
      throw UsageError(option.name() + " is for suites, and this is a scene; leave it out");
    if (suite && option.has_name("--every"))
      throw UsageError(
          "--every is for scenes; leave it out, or write `frames` into `render` of the suite file");
    if (suite && option.has_name("--history"))
      throw UsageError("--history is for scenes; leave it out, or write `history` into the scene file");
    if (suite && !in(of_suites, option))
      throw UsageError(
          option.name() +
          " is for scenes; leave it out, "
          "or write it into the suite file: settings into `set`, drawing into `render`, the limit as `fail`");
  }
}

Json suite_json(const SuiteFile& suite, const SnapshotArguments& o) {
  Json json = json_answer("snapshot");
  json["suite"] = suite.path.string();
  json["folder"] = *o.out;
  return json;
}

int list_suite(const SuiteFile& suite, const SnapshotArguments& o, const std::vector<PlannedEntry>& entries,
               std::ostream& out) {
  Json json = suite_json(suite, o);
  json["entries"] = Json::array();
  for (const PlannedEntry& planned : entries) json["entries"].add(entry_json(planned, nullptr));
  out << (o.json ? json.dump(2) + "\n" : list_of_entries(entries, text_columns(out)));
  return exit_fine;
}

int exit_code_of(const std::vector<EntryOutcome>& outcomes, int of_runs) {
  if (of_runs != exit_fine) return of_runs;
  const auto any = [&](const auto& is) { return std::ranges::any_of(outcomes, is); };
  if (any([](const EntryOutcome& outcome) { return outcome.planned->run.has_diverged(); }))
    return exit_diverged;
  if (any([](const EntryOutcome& outcome) { return !outcome.problem.empty(); })) return exit_wrong_input;
  return any([](const EntryOutcome& outcome) { return !outcome.passed(); }) ? exit_different : exit_fine;
}

int snapshot_of_suite(SnapshotArguments o, const fs::path& file, Streams streams) {
  const SuiteFile suite = read_suite(file);
  if (!o.out) o.out = "out/snapshot-" + file.stem().string();
  const SuiteOptions options{*o.out, o.baseline, o.only, o.update, std::max(o.threads, 1)};
  if (o.jobs) check_threads(*o.jobs, "--jobs");
  if (o.list) return list_suite(suite, o, plan_suite(suite, options, false), streams.out);
  std::vector<PlannedEntry> entries = plan_suite(suite, options);
  const FolderLock lock(*o.out, FolderLock::Of::sweep, "taut snapshot", streams.err);
  const Interrupts interrupts;
  std::vector<SweepRun*> runs;
  for (PlannedEntry& planned : entries) runs.push_back(&planned.run);
  Progress progress(streams.err, progress_style(streams.err, o.quiet));
  SweepRunner runner(runs, o.jobs.value_or(std::max(1, cores() / options.threads)), interrupts, progress,
                     {[](const SweepRun&) {}, [] {}});
  const SweepEnd end = runner.execute(suite.title);
  if (end.interrupted) return Interrupts::exit_code();
  std::vector<EntryOutcome> outcomes;
  if (o.update)
    outcomes = update_entries(entries);
  else
    for (const PlannedEntry& planned : entries) outcomes.push_back(compare_entry(planned));
  write_suite_record(*o.out, record_of(suite, options, outcomes));
  Json json = suite_json(suite, o);
  const bool passed = std::ranges::all_of(outcomes, &EntryOutcome::passed);
  json["updated"] = o.update && passed;
  json["passed"] = passed;
  json["entries"] = Json::array();
  for (const EntryOutcome& outcome : outcomes) json["entries"].add(entry_json(*outcome.planned, &outcome));
  streams.out << (o.json ? json.dump(2) + "\n" : table_of_outcomes(outcomes, text_columns(streams.out)));
  o.publish(suite_report(suite, outcomes), streams.err);
  return exit_code_of(outcomes, end.code);
}

}  // namespace

std::function<int(Streams)> declare_snapshot(Options& command) {
  auto options = std::make_shared<SnapshotArguments>();
  declare_options(command, *options);
  return [options, &command](Streams streams) {
    const std::optional<fs::path> suite = suite_of(options->scene);
    check_options(command, suite.has_value());
    return suite ? snapshot_of_suite(*options, *suite, streams) : snapshot_of_scene(*options, streams);
  };
}

}  // namespace taut::cli
