#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "cli/sweep/plan.hpp"
#include "cli/system/child_process.hpp"
#include "cli/system/interrupts.hpp"
#include "cli/system/progress.hpp"

namespace taut::cli {

struct SweepEnd {
  bool interrupted = false;
  int code = 0;  // gravest exit code of the `broken` runs
};

struct SweepEvents {
  std::function<void(const SweepRun&)> ended;
  std::function<void()> waiting;  // several times a second
};

/// Does `jobs` runs at a time, each in its own process; the longest start first.
class SweepRunner {
 public:
  SweepRunner(std::vector<SweepRun*> runs, int jobs, const Interrupts& interrupts, Progress& progress,
              SweepEvents events);

  SweepEnd execute(const std::string& title);

 private:
  struct Job {
    SweepRun* run;
    std::unique_ptr<ChildProcess> process;
    double share = 0;
  };
  bool may_start() const;
  void wait_for_something();
  void finish(Job& job);
  void pass_on_interrupt();
  void show_progress();

  std::vector<SweepRun*> waiting_;  // the last one starts next
  std::size_t jobs_;
  const Interrupts& interrupts_;
  Progress& progress_;
  SweepEvents events_;
  std::vector<Job> at_work_;
  std::size_t count_, done_ = 0;
  double work_ = 0, work_done_ = 0;
  Stopwatch since_looked_;
  bool passed_on_ = false;
  SweepEnd end_;
};

}  // namespace taut::cli
