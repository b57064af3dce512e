#include <algorithm>
#include <filesystem>
#include <ostream>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/report_options.hpp"
#include "cli/sweep/emit.hpp"
#include "cli/sweep/options.hpp"
#include "cli/sweep/results.hpp"
#include "cli/sweep/runner.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/folder_lock.hpp"
#include "cli/system/machine.hpp"
#include "cli/text/format.hpp"
#include "engine/core/machine.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

struct SweepArguments : SweepOptions, ReportOptions {};

SweepPlan make_plan(const SweepOptions& o) {
  SweepPlan plan = plan_sweep(make_request(o));
  const auto count = static_cast<int>(plan.runs.size());
  if (o.index && *o.index >= count)
    throw UsageError(fmt::format("--index is {}; it must be from 0 to {}", *o.index, count - 1));
  return plan;
}

std::string listing(const SweepPlan& plan) {
  std::vector<std::vector<std::string>> rows{{"run", "sets", "folder", "state"}};
  for (const SweepRun& run : plan.runs) {
    const auto again = std::ranges::count(run.repetitions, SweepRunState::done, &SweepRun::state);
    rows.push_back({std::to_string(run.index), text_of(run.settings), run.folder,
                    std::string(name(run.state)) +
                        (run.repetitions.empty() ? "" : ", repetitions: " + std::to_string(again))});
  }
  const auto done = std::ranges::count(plan.runs, SweepRunState::done, &SweepRun::state);
  return fmt::format("{}\n{} of {} runs are done in {}\n", in_columns(rows, 0), done, plan.runs.size(),
                     plan.folder.string());
}

bool measures_costs(const SweepPlan& plan) {
  return !plan.runs.empty() && !plan.runs.front().repetitions.empty();
}

int emit(const SweepOptions& o, const Options& command, const SweepPlan& plan, std::ostream& out) {
  const EmitForm& form = find_emit_form(*o.emit);
  const std::string script = emit_script(form, plan.title, static_cast<int>(plan.runs.size()), o.run.threads,
                                         measures_costs(plan), command_to_repeat(command));
  if (!o.run.out) {
    out << script;
    return exit_fine;
  }
  std::error_code error;
  fs::create_directories(plan.folder, error);
  const fs::path file = plan.folder / form.file;
  write_atomically(file, script);
  fs::permissions(file, fs::perms::owner_exec, fs::perm_options::add, error);
  out << file.string() << '\n';
  return exit_fine;
}

int number_of_jobs(const SweepPlan& plan, const SweepOptions& o) {
  const bool costs = measures_costs(plan);
  const int most = std::max(1, (costs ? physical_cores() : cores()) / o.run.threads);
  if (costs && o.jobs > most)
    throw UsageError(
        fmt::format("--jobs is {}; a sweep with repetitions measures costs, so at most {} are allowed: "
                    "physical cores divided by --threads",
                    *o.jobs, most));
  return o.jobs.value_or(most);
}

std::vector<SweepRun*> what_to_run(SweepPlan& plan, const SweepOptions& o, std::ostream& err) {
  std::vector<SweepRun*> runs;
  int outdated = 0;
  for (SweepRun& of_row : plan.runs)
    for (SweepRun* run : of_row.all()) {
      if (o.index && run->index != *o.index) continue;
      run->read_folder();  // another process may have changed it
      if (run->state == SweepRunState::damaged)
        err << "taut: run " << run->index << " (" << text_of(run->settings)
            << "): " << RunFolder(*run->options.out).record().string()
            << " is damaged; the run is repeated\n";
      outdated += run->state == SweepRunState::outdated;
      run->forced = o.force;
      if (run->forced) run->forget();
      if (run->state != SweepRunState::done) runs.push_back(run);
    }
  if (outdated > 0)
    err << "taut: " << outdated << (outdated == 1 ? " finished run" : " finished runs") << " in '"
        << plan.folder.string() << "' " << (outdated == 1 ? "has" : "have")
        << " other settings, other input files or another version of taut and will be replaced; "
           "to keep the results, name another folder with --out\n";
  return runs;
}

Json json(const SweepPlan& plan, std::optional<int> index) {
  Json answer = json_answer("sweep");
  answer["folder"] = plan.folder.string();
  return answer.with(results_tree(plan, index));
}

std::string text(const SweepPlan& plan, const SweepOptions& o) {
  if (o.index) {
    const SweepRun& run = plan.runs[static_cast<std::size_t>(*o.index)];
    return fmt::format("run {} ({}): {}, in {}\n", run.index, text_of(run.settings), outcome(run),
                       *run.options.out);
  }
  return fmt::format("{}\nresults  {}, results.json\n", results_table(plan),
                     (plan.folder / "results.csv").string());
}

void report_other_runs(const SweepPlan& plan, std::ostream& err) {
  std::vector<std::string> others;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(plan.folder, error)) {
    const std::string name = entry.path().filename().string();
    if (fs::exists(entry.path() / "run.json", error) &&
        std::ranges::find(plan.runs, name, &SweepRun::folder) == plan.runs.end())
      others.push_back(name);
  }
  if (others.empty()) return;
  constexpr std::size_t most = 5;
  std::ranges::sort(others);
  const std::size_t number = others.size();
  if (number > most) others.resize(most);
  err << "taut: " << number << (number == 1 ? " run" : " runs") << " of another grid in '"
      << plan.folder.string() << "' " << (number == 1 ? "is" : "are")
      << " kept, but not in the results: " << join(others) << (number > most ? ", ..." : "") << '\n';
}

TestReport test_report(const SweepPlan& plan, std::optional<int> index,
                       const std::optional<Verdict>& fail_on) {
  TestReport report{"sweep", plan.title, {}};
  for (const SweepRun& run : plan.runs)
    if (!index || run.index == *index) report.cases.push_back(test_case(run, fail_on));
  return report;
}

bool answer(const SweepPlan& plan, const SweepArguments& o, const std::optional<Verdict>& fail_on,
            Streams streams) {
  using Result = TestCase::Result;
  const TestReport report = test_report(plan, o.index, fail_on);
  if (o.json) {
    Json results = json(plan, o.index);
    results["passed"] = std::ranges::all_of(
        report.cases, [](Result r) { return r == Result::passed; }, &TestCase::result);
    streams.out << results.dump(2) << '\n';
  } else {
    streams.out << text(plan, o);
  }
  o.publish(report, streams.err);
  return std::ranges::find(report.cases, Result::failed, &TestCase::result) == report.cases.end();
}

class ResultsWriter {
 public:
  ResultsWriter(const SweepPlan& plan, bool whole_sweep) : plan_(plan), active_(whole_sweep) {}

  void write() {
    pending_ = false;
    if (!active_) return;
    const Stopwatch watch;
    write_results(plan_);
    took_ = watch.seconds();
    since_written_ = {};
  }
  void changed() { pending_ = true; }
  void write_when_due() {
    if (pending_ && since_written_.seconds() > 20 * took_) write();
  }

 private:
  const SweepPlan& plan_;
  bool active_, pending_ = false;
  double took_ = 0;  // s
  Stopwatch since_written_;
};

int execute(SweepPlan& plan, const SweepArguments& o, Streams streams) {
  for (const std::string& remark : plan.remarks) streams.err << "taut: " << remark << '\n';
  const std::optional<Verdict> fail_on = parse_verdict(o.fail_on);
  if (o.jobs) check_threads(*o.jobs, "--jobs");
  const int jobs = number_of_jobs(plan, o);
  using Of = FolderLock::Of;
  const FolderLock lock(plan.folder, o.index ? Of::part_of_sweep : Of::sweep, "taut sweep", streams.err);
  const Interrupts interrupts;
  const std::vector<SweepRun*> runs = what_to_run(plan, o, streams.err);
  Progress progress(streams.err, progress_style(streams.err, o.quiet));
  ResultsWriter results(plan, !o.index);
  const auto ended = [&](const SweepRun& run) {
    progress.clear();
    if (!run.problem.empty())
      streams.err << "taut: run " << run.index << " (" << text_of(run.settings) << "): " << run.problem
                  << '\n';
    results.changed();
  };
  results.write();
  SweepEnd end;
  if (!runs.empty()) {
    SweepRunner runner(runs, jobs, interrupts, progress, {ended, [&] { results.write_when_due(); }});
    end = runner.execute(plan.title);
    results.write();
  }
  const bool passed = answer(plan, o, fail_on, streams);
  if (!o.index) report_other_runs(plan, streams.err);
  if (end.code != exit_fine) return end.code;
  if (end.interrupted) return Interrupts::exit_code();
  std::ostream nowhere(nullptr);
  std::ostream& out = o.json ? nowhere : streams.out;
  if (!o.index)
    if (const int code = draw_pictures(plan.pictures, plan.folder, {out, streams.err}); code != exit_fine)
      return code;
  return passed ? exit_fine : exit_diverged;
}

int sweep(const SweepArguments& o, const Options& command, Streams streams) {
  if (o.emit) find_emit_form(*o.emit);
  if (o.emit && o.json) throw UsageError("--emit prints a script; leave --json out");
  if ((o.emit || o.list) && !o.junit.empty())
    throw UsageError("--junit needs a sweep that runs; leave --emit and --list out");
  SweepPlan plan = make_plan(o);
  if (o.emit) return emit(o, command, plan, streams.out);
  if (!o.list) return execute(plan, o, streams);
  streams.out << (o.json ? json(plan, o.index).dump(2) + "\n" : listing(plan));
  return exit_fine;
}

}  // namespace

std::function<int(Streams)> declare_sweep(Options& command) {
  auto options = std::make_shared<SweepArguments>();
  declare_sweep_options(command, *options);
  options->declare_json(command);
  options->declare_junit(command);
  return [options, &command](Streams streams) { return sweep(*options, command, streams); };
}

}  // namespace taut::cli
