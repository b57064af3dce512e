#pragma once

#include <memory>
#include <vector>

#include "cli/run/run.hpp"
#include "cli/system/atomic_file.hpp"
#include "engine/core/archive.hpp"
#include "engine/snapshot_blend.hpp"

namespace taut::cli {

/// Interpolates within the last step, without affecting the run.
class LastStep {
 public:
  explicit LastStep(const Simulation& simulation) : simulation_(simulation) {}

  /// Stores the start of the next step.
  void begin() { before_ = simulation_.snapshot(); }
  /// Particles at time `t` within the step after `begin`, or at its end. Valid until the next call.
  const Snapshot& at(double t);

 private:
  const Simulation& simulation_;
  Snapshot before_, shown_;
};

/// An output of a run. It does not affect the steps. All writing throws OutputError.
class RunOutput {
 public:
  virtual ~RunOutput() = default;
  RunOutput() = default;
  RunOutput(const RunOutput&) = delete;
  RunOutput& operator=(const RunOutput&) = delete;

  /// Called after the run has claimed its folder.
  virtual void open(AppendFile::Start) {}
  /// Next output time, s; may be infinity.
  virtual double next() const = 0;
  /// Whether states at exact times are needed, not at the first step at or after them.
  virtual bool is_at_its_time() const { return true; }
  /// Whether the final state must be taken too, at any time.
  virtual bool lacks_the_end() const { return false; }
  /// Outputs everything due, and updates the result. Called after the first step at or past `next`.
  virtual void take() = 0;
  /// Waits for its background work.
  virtual void settle() {}
  /// Waits until all output is on disk.
  virtual void put_on_disk() {}
  /// Updates the result, before run.json is written.
  virtual void tell() {}
  /// Does deferred work after the run. False if interrupted.
  virtual bool complete(const Interrupts&, Progress&) { return true; }

  /// `save` requires `settle`. `load` changes no file.
  virtual void save(Saver& saver) = 0;
  virtual void load(Loader& loader) = 0;
  /// Removes output newer than the loaded state.
  virtual void take_back() {}
};

/// All outputs in calling order; they update `result`. Does not change the folder. Throws SceneError for a line that
/// leaves its body.
std::vector<std::unique_ptr<RunOutput>> make_outputs(const RunPlan& plan, const Simulation& simulation,
                                                     LastStep& last_step, RunResult& result);

}  // namespace taut::cli
