#pragma once

#include <memory>
#include <vector>

#include "cli/run/run.hpp"
#include "cli/system/atomic_file.hpp"
#include "engine/core/archive.hpp"
#include "engine/snapshot_blend.hpp"

namespace taut::cli {

/// State at any time within the last step. The simulation is not affected.
class LastStep {
 public:
  explicit LastStep(const Simulation& simulation) : simulation_(simulation) {}

  /// Stores the start of a step.
  void begin() { before_ = simulation_.snapshot(); }
  /// State at `t` in that step. Valid until the next call.
  const Snapshot& at(double t);

 private:
  const Simulation& simulation_;
  Snapshot before_, shown_;
};

/// An output of a run, without effect on its steps. Writing throws OutputError.
class RunOutput {
 public:
  virtual ~RunOutput() = default;
  RunOutput() = default;
  RunOutput(const RunOutput&) = delete;
  RunOutput& operator=(const RunOutput&) = delete;

  /// Called after the run has claimed its folder.
  virtual void open(AppendFile::Start) {}
  /// Next output time, s, or infinity.
  virtual double next() const = 0;
  /// Whether it takes states at its exact times, between steps. Otherwise it takes the first step at or after each
  /// time.
  virtual bool needs_exact_time() const { return true; }
  /// Whether it must also take the final state, at any time.
  virtual bool needs_final_state() const { return false; }
  /// Writes all output that is due, and updates the result. Called after the first step at or after `next`.
  virtual void write_due() = 0;
  /// Waits for background work.
  virtual void wait() {}
  /// Waits until all output since the last call is on disk.
  virtual void put_on_disk() {}
  /// Updates the result before run.json is written.
  virtual void update_result() {}
  /// Whether `complete` has work to do.
  virtual bool has_deferred_work() const { return false; }
  /// Does deferred work; false if interrupted.
  virtual bool complete(const Interrupts&, Progress&) { return true; }

  /// State for checkpoints. Call `wait` before saving; loading changes no file.
  virtual void save(Saver& saver) = 0;
  virtual void load(Loader& loader) = 0;
  /// Called after `load` if `until` is later than in the loaded state.
  virtual void run_on() {}
  /// Removes output newer than the loaded state.
  virtual void discard_newer() {}
};

/// Creates all outputs, in the order in which they take a state. They write to `result`; the folder is not touched
/// yet. Throws SceneError for a line that leaves its body.
std::vector<std::unique_ptr<RunOutput>> make_outputs(const RunPlan& plan, const Simulation& simulation,
                                                     LastStep& last_step, RunResult& result);

}  // namespace taut::cli
