#include <algorithm>
#include <filesystem>
#include <ostream>
#include <thread>

#include <CLI/CLI.hpp>

#include "cli/command.hpp"
#include "cli/exit_code.hpp"
#include "cli/option_checks.hpp"
#include "cli/sweep_emit.hpp"
#include "cli/sweep_file.hpp"
#include "cli/sweep_lock.hpp"
#include "cli/sweep_results.hpp"
#include "cli/sweep_runner.hpp"
#include "cli/text.hpp"
#include "cli/whole_file.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string what;  // a sweep file or a scene
  std::vector<std::string> grid;
  RunOptions run;
  std::optional<std::string> emit, fail_on;
  std::optional<int> jobs, index;
  bool list = false, force = false, render = false, quiet = false;
};

void declare_options(CLI::App& app, Options& o) {
  app.add_option(
         "SWEEP", o.what,
         "a sweep file, or the name of one in scenes/studies/; with --grid a scene, as for `taut run`")
      ->option_text(" ")
      ->required();
  app.add_option(
         "--grid", o.grid,
         "what to vary: all that --set takes, and method, spacing, until, cfl, stepping; v1,v2,... or "
         "lo:hi:step with both ends. Several of them: every combination")
      ->option_text("NAME=VALUES ...")
      ->allow_extra_args(false);
  app.add_flag("--list", o.list, "say what would run, and what is done already");
  app.add_option("--jobs", o.jobs, "runs at a time; default: as many as there are cores for")
      ->option_text("N")
      ->check(positive_whole_number);
  app.add_option("--index", o.index, "do this one of the runs only; they are numbered from 0")
      ->option_text("N")
      ->check(whole_number);
  app.add_flag("--force", o.force, "do again what is done already");
  app.add_option("--emit", o.emit,
                 "write a script that does the runs one by one: slurm (array job) or parallel")
      ->option_text("KIND");
  app.add_option("--out", o.run.out, "the folder of results and runs; default: out/FILE or out/SCENE-sweep")
      ->option_text("DIR");
  declare_setting_options(app, o.run);
  app.add_flag("--render", o.render, "draw frames; so does each of the options of drawing");
  declare_output_options(app, o.run);
  o.run.threads = 1;
  app.add_option("--threads", o.run.threads, "of each run; default: 1")
      ->option_text("N")
      ->check(positive_whole_number);
  app.add_option("--fail-on", o.fail_on, "exit code 3 if a verdict is this one or worse")
      ->option_text("VERDICT");
  app.add_flag("--quiet", o.quiet, "no progress on stderr");
}

bool draws(const Options& o) {
  const DrawingOptions& d = o.run.drawing;
  return o.render || o.run.frames || o.run.every || d.color || d.range || d.colormap || d.size;
}

bool fixed_by_command(const RunOptions& run, const std::string& name) {
  if (name == "method") return run.method.has_value();
  if (name == "spacing") return run.spacing.has_value();
  if (name == "until") return run.until.has_value();
  return std::ranges::any_of(run.set, [&](const std::string& s) { return s.starts_with(name + "="); });
}

SweepRequest request_of_scene(const Options& o) {
  const fs::path scene = find_scene(o.what);
  if (is_sweep_file(scene))
    throw UsageError("'" + o.what + "' is a sweep file, which has a grid of its own; leave --grid out");
  std::vector<Axis> axes;
  for (const std::string& text : o.grid) axes.push_back(parse_axis(text));
  SweepRequest request;
  request.base = o.run;
  request.base.scene = scene.string();
  request.rows = all_combinations(axes);
  request.folder = o.run.out.value_or("out/" + scene.stem().string() + "-sweep");
  return request;
}

SweepRequest request_of_file(const Options& o) {
  SweepFile file = read_sweep(find_sweep(o.what));
  SweepRequest request;
  request.title = file.title;
  request.file = file.path;
  request.base = o.run;
  request.base.scene = file.scene;
  // the command line is stronger
  std::erase_if(file.set, [&](const Setting& s) { return fixed_by_command(o.run, s.name); });
  request.set = std::move(file.set);
  request.rows = std::move(file.rows);
  request.folder = o.run.out.value_or("out/" + file.path.stem().string());
  return request;
}

SweepPlan make_sweep(const Options& o) {
  SweepRequest request = o.grid.empty() ? request_of_file(o) : request_of_scene(o);
  request.base.no_render = !draws(o);
  SweepPlan plan = plan_sweep(request);
  const auto count = static_cast<int>(plan.runs.size());
  if (o.index && *o.index >= count)
    throw UsageError("--index " + std::to_string(*o.index) + ": the runs are numbered from 0 to " +
                     std::to_string(count - 1));
  return plan;
}

std::string listing(const SweepPlan& plan) {
  std::vector<std::vector<std::string>> rows{{"run", "sets", "folder", "state"}};
  for (const SweepRun& run : plan.runs)
    rows.push_back(
        {std::to_string(run.index), text_of(run.settings), run.folder, std::string(name(run.state))});
  const auto done = std::ranges::count(plan.runs, RunState::done, &SweepRun::state);
  return in_columns(rows, 0) + "\n" + std::to_string(done) + " of " + std::to_string(plan.runs.size()) +
         " runs are done in " + plan.folder.string() + "\n";
}

/// The command without what belongs to this call of it alone; an option and its value are one word.
std::vector<std::string> lasting_words(const CLI::App& app) {
  const std::vector<std::string> passing = {"list", "jobs", "index", "force", "emit", "quiet"};
  std::vector<std::string> words{fs::read_symlink("/proc/self/exe").string(), "sweep"};
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_lnames().empty() ? "" : option->get_lnames().front();
    if (option->count() == 0 || std::ranges::find(passing, name) != passing.end()) continue;
    const bool flag = option->get_items_expected_max() == 0;
    for (const std::string& value : option->results())
      words.push_back(name.empty() ? value : "--" + name + (flag ? "" : "=" + value));
  }
  return words;
}

int emit(const Options& o, const CLI::App& app, const SweepPlan& plan, std::ostream& out) {
  const EmitForm& form = find_emit_form(*o.emit);
  const std::string script =
      emit_script(form, plan.title, static_cast<int>(plan.runs.size()), o.run.threads, lasting_words(app));
  if (!o.run.out) {
    out << script;
    return exit_fine;
  }
  std::error_code error;
  fs::create_directories(plan.folder, error);
  const fs::path file = plan.folder / form.file;
  write_whole(file, script);
  fs::permissions(file, fs::perms::owner_exec, fs::perm_options::add, error);
  out << file.string() << '\n';
  return exit_fine;
}

int default_jobs(int threads) {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / threads);
}

std::vector<SweepRun*> what_to_run(SweepPlan& plan, const Options& o) {
  std::vector<SweepRun*> runs;
  for (SweepRun& run : plan.runs) {
    if (o.index && run.index != *o.index) continue;
    run.look();  // another program may have worked here until the lock was ours
    if (o.force) run.forget();
    if (run.state != RunState::done) runs.push_back(&run);
  }
  return runs;
}

std::string report(const SweepPlan& plan, const Options& o) {
  if (o.index) {
    const SweepRun& run = plan.runs[static_cast<std::size_t>(*o.index)];
    return "run " + std::to_string(run.index) + " (" + text_of(run.settings) + "): " + outcome(run) +
           ", in " + *run.options.out + "\n";
  }
  return results_table(plan) + "\nresults  " + (plan.folder / "results.csv").string() + ", results.json\n";
}

bool fails(const SweepPlan& plan, const std::optional<Verdict>& fail_on) {
  const auto bad = [&](const SweepRun& run) {
    if (run.state != RunState::done) return false;
    return find_verdict(run.record.value("verdict", "")) >= fail_on;
  };
  return fail_on && std::ranges::any_of(plan.runs, bad);
}

/// Keeps the results of a whole sweep up to date; single runs leave them to a later call.
class ResultsWriter {
 public:
  ResultsWriter(const SweepPlan& plan, bool whole_sweep) : plan_(plan), active_(whole_sweep) {}

  void write() {
    if (!active_) return;
    const Stopwatch watch;
    write_results(plan_);
    took_ = watch.seconds();
    since_written_ = {};
  }
  /// Unless that would take a good part of the time: there may be thousands of short runs.
  void write_soon() {
    if (since_written_.seconds() > 20 * took_) write();
  }

 private:
  const SweepPlan& plan_;
  bool active_;
  double took_ = 0;  // s
  Stopwatch since_written_;
};

int execute(SweepPlan& plan, const Options& o, Streams streams) {
  const std::optional<Verdict> fail_on = parse_verdict(o.fail_on);
  const SweepLock lock(plan.folder, o.index ? plan.runs[static_cast<std::size_t>(*o.index)].folder : "");
  const Interrupts interrupts;
  const std::vector<SweepRun*> runs = what_to_run(plan, o);
  Progress progress(streams.err, progress_style(streams.err, o.quiet));
  ResultsWriter results(plan, !o.index);
  const auto ended = [&](const SweepRun& run) {
    progress.clear();
    if (!run.problem.empty())
      streams.err << "taut: run " << run.index << " (" << text_of(run.settings) << "): " << run.problem
                  << '\n';
    results.write_soon();
  };
  results.write();
  SweepEnd end;
  if (!runs.empty()) {
    SweepRunner runner(runs, o.jobs.value_or(default_jobs(o.run.threads)), interrupts, progress, ended);
    end = runner.execute(plan.title);
    results.write();
  }
  streams.out << report(plan, o);
  if (end.code != exit_fine) return end.code;
  if (end.interrupted) return exit_interrupted;
  return fails(plan, fail_on) ? exit_diverged : exit_fine;
}

int sweep(const Options& o, const CLI::App& app, Streams streams) {
  if (o.emit) find_emit_form(*o.emit);
  SweepPlan plan = make_sweep(o);
  if (o.emit) return emit(o, app, plan, streams.out);
  if (!o.list) return execute(plan, o, streams);
  streams.out << listing(plan);
  return exit_fine;
}

}  // namespace

std::function<int(Streams)> declare_sweep(CLI::App& app) {
  auto options = std::make_shared<Options>();
  declare_options(app, *options);
  return [options, &app](Streams streams) { return sweep(*options, app, streams); };
}

}  // namespace taut
