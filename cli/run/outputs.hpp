#pragma once

#include <memory>
#include <vector>

#include "cli/run/run.hpp"
#include "cli/system/atomic_file.hpp"
#include "engine/core/archive.hpp"
#include "engine/snapshot_blend.hpp"

namespace taut::cli {

/// Interpolates states within the last step.
class LastStep {
 public:
  explicit LastStep(const Simulation& simulation) : simulation_(simulation) {}

  void begin() { before_ = simulation_.snapshot(); }
  /// Valid until the next call.
  const Snapshot& at(double t);

 private:
  const Simulation& simulation_;
  Snapshot before_, shown_;
};

/// Writing throws OutputError.
class RunOutput {
 public:
  virtual ~RunOutput() = default;
  RunOutput() = default;
  RunOutput(const RunOutput&) = delete;
  RunOutput& operator=(const RunOutput&) = delete;

  /// Called after the run has claimed its folder.
  virtual void open(AppendFile::Start) {}
  /// Time of the next output in s, or infinity.
  virtual double next() const = 0;
  /// False: takes the first step at or after each time.
  virtual bool needs_exact_time() const { return true; }
  virtual bool needs_final_state() const { return false; }
  /// Called at t = 0, when `next` is reached and, if `needs_final_state`, at the end.
  virtual void write_due() = 0;
  virtual void wait() {}
  virtual void put_on_disk() {}
  /// Called before run.json is written.
  virtual void update_result() {}
  virtual bool has_deferred_work() const { return false; }
  /// Returns false if interrupted.
  virtual bool complete(const Interrupts&, Progress&) { return true; }

  /// Call `wait` before saving; loading changes no file.
  virtual void save(Saver& saver) = 0;
  virtual void load(Loader& loader) = 0;
  /// Called after `load` if `until` is later than in the checkpoint.
  virtual void run_on() {}
  /// Removes output newer than the loaded state.
  virtual void discard_newer() {}
};

/// In the order in which outputs process a state. Throws SceneError and UsageError.
std::vector<std::unique_ptr<RunOutput>> make_outputs(const RunPlan& plan, const Simulation& simulation,
                                                     LastStep& last_step, RunResult& result);

}  // namespace taut::cli
