#include "cli/sweep/runner.hpp"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <iostream>
#include <poll.h>

#include <fmt/core.h>

#include "cli/run/report.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/folder_lock.hpp"

namespace taut::cli {
namespace {

constexpr double look_interval = 2.0;  // s

/// Works like `taut run`, without progress. Skips a run that another process has done, unless it is forced.
int run_alone(SweepRun run) {
  const auto work = [&]() -> int {
    const Stopwatch setup;
    const FolderLock lock(*run.options.out, FolderLock::Of::run, "taut sweep", std::cerr);
    run.read_folder();
    if (!run.forced && run.state == SweepRunState::done) return exit_fine;
    const RunPlan plan = make_plan(run.options);
    const Interrupts interrupts;
    Progress silent(std::cerr, Progress::Style::none);
    return exit_code(run_scene(plan, interrupts, silent, setup.seconds()));
  };
  return guarded(work, std::cerr);
}

std::string last_line(std::string text) {
  text.erase(text.find_last_not_of('\n') + 1);
  text.erase(0, text.rfind('\n') + 1);
  constexpr std::string_view prefix = "taut: ";
  return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

double share_done(const SweepRun& run) {
  const std::optional<StoredRecord> record = read_record(RunFolder(*run.options.out).record());
  if (!record || record->status != RunRecord::Status::running || !(record->until > 0)) return 0;
  return std::clamp(record->reached / record->until, 0.0, 1.0);
}

int gravest(int a, int b) {
  for (const int code : {exit_bug, exit_not_written, exit_wrong_input})
    if (a == code || b == code) return code;
  return exit_fine;
}

}  // namespace

SweepRunner::SweepRunner(std::vector<SweepRun*> runs, int jobs, const Interrupts& interrupts,
                         Progress& progress, SweepEvents events)
    : waiting_(std::move(runs)),
      jobs_(static_cast<std::size_t>(jobs)),
      interrupts_(interrupts),
      progress_(progress),
      events_(std::move(events)),
      count_(waiting_.size()) {
  for (const SweepRun* run : waiting_) work_ += run->work;
  std::ranges::reverse(waiting_);
  std::ranges::stable_sort(waiting_, {}, [](const SweepRun* run) { return run->work; });
}

SweepEnd SweepRunner::execute(const std::string& title) {
  progress_.begin(title);
  while (may_start() || !at_work_.empty()) {
    while (may_start() && at_work_.size() < jobs_) {
      SweepRun* run = waiting_.back();
      at_work_.push_back({run, std::make_unique<ChildProcess>([run] { return run_alone(*run); })});
      waiting_.pop_back();
    }
    wait_for_something();
    pass_on_interrupt();
    show_progress();
    events_.waiting();
  }
  end_.interrupted = interrupts_.interrupted();
  progress_.end(fmt::format("{} of {} runs", done_, count_));
  return end_;
}

bool SweepRunner::may_start() const { return !waiting_.empty() && !interrupts_.interrupted(); }

void SweepRunner::wait_for_something() {
  constexpr int patience = 100;  // ms
  std::vector<pollfd> descriptors;
  for (const Job& job : at_work_) descriptors.push_back({job.process->descriptor(), POLLIN, 0});
  if (::poll(descriptors.data(), descriptors.size(), patience) <= 0) return;
  for (std::size_t k = 0; k < descriptors.size(); ++k)
    if (descriptors[k].revents != 0 && !at_work_[k].process->read_output()) finish(at_work_[k]);
  std::erase_if(at_work_, [](const Job& job) { return job.process == nullptr; });
}

void SweepRunner::finish(Job& job) {
  const ChildProcess::End end = job.process->wait();
  job.process.reset();
  SweepRun& run = *job.run;
  run.read_folder();
  const bool stopped = passed_on_ && (end.code == exit_by_signal(SIGTERM) || end.signal == SIGTERM);
  if (run.state != SweepRunState::done && !stopped) {
    const bool by_signal = end.signal != 0;
    const bool changed = !by_signal && end.output.empty() && run.state == SweepRunState::outdated;
    run.state = SweepRunState::broken;
    run.record.reset();
    run.problem = by_signal ? std::string("killed: ") + ::strsignal(end.signal)
                  : changed
                      ? "the scene or a file that it names was changed during the sweep; repeat the sweep"
                      : last_line(end.output);
    if (run.problem.empty()) run.problem = "ended with exit code " + std::to_string(end.code);
    const bool known = end.code == exit_wrong_input || end.code == exit_not_written;
    const int of_child = !by_signal && known ? end.code : int{exit_bug};
    end_.code = gravest(end_.code, changed ? int{exit_wrong_input} : of_child);
  }
  if (!stopped) {
    ++done_;
    work_done_ += run.work;
  }
  events_.ended(run);
}

void SweepRunner::pass_on_interrupt() {
  if (passed_on_ || !interrupts_.interrupted()) return;
  passed_on_ = true;
  for (const Job& job : at_work_) job.process->ask_to_stop();
}

void SweepRunner::show_progress() {
  if (since_looked_.seconds() > look_interval) {
    for (Job& job : at_work_) job.share = share_done(*job.run);
    since_looked_ = {};
  }
  double done = work_done_;
  for (const Job& job : at_work_) done += job.share * job.run->work;
  progress_.show(done / work_, fmt::format("{} of {} runs", done_, count_));
}

}  // namespace taut::cli
