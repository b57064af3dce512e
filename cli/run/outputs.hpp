#pragma once

#include <memory>
#include <vector>

#include "cli/run/run.hpp"
#include "cli/system/atomic_file.hpp"
#include "engine/core/archive.hpp"
#include "engine/snapshot_blend.hpp"

namespace taut::cli {

/// Interpolates the particles within the last step, without affecting the run.
class LastStep {
 public:
  explicit LastStep(const Simulation& simulation) : simulation_(simulation) {}

  /// Stores the current state as the start of the next step.
  void begin() { before_ = simulation_.snapshot(); }
  /// Particles at time `t` within the step after `begin`, or at its end. Valid until the next call.
  const Snapshot& at(double t);

 private:
  const Simulation& simulation_;
  Snapshot before_, shown_;
};

/// An output of a run. It does not affect the time steps. All writing throws OutputError.
class RunOutput {
 public:
  virtual ~RunOutput() = default;
  RunOutput() = default;
  RunOutput(const RunOutput&) = delete;
  RunOutput& operator=(const RunOutput&) = delete;

  /// Opens the file, after the run has claimed its folder.
  virtual void open(AppendFile::Start) {}
  /// Next output time, s; infinity if there is none.
  virtual double next() const = 0;
  /// Whether it needs states at exact times, not at the first step at or after them.
  virtual bool is_at_its_time() const { return true; }
  /// Whether it must also take the final state, at any time.
  virtual bool lacks_the_end() const { return false; }
  /// Outputs everything due, after the first step at or past `next`. Updates the run's result.
  virtual void take() = 0;
  /// Waits for its background work.
  virtual void settle() {}
  /// Waits until its output is on disk.
  virtual void put_on_disk() {}
  /// Updates the result before run.json is written.
  virtual void tell() {}
  /// Completes deferred work after the run. False if interrupted.
  virtual bool complete(const Interrupts&, Progress&) { return true; }

  /// `save` requires `settle`. `load` changes no file.
  virtual void save(Saver& saver) = 0;
  virtual void load(Loader& loader) = 0;
  /// Removes output that is newer than the loaded state.
  virtual void take_back() {}
};

/// All outputs of a run, in calling order. They update `result`. The folder is not changed yet. Throws SceneError for
/// a line that leaves its body.
std::vector<std::unique_ptr<RunOutput>> make_outputs(const RunPlan& plan, const Simulation& simulation,
                                                     LastStep& last_step, RunResult& result);

}  // namespace taut::cli
