#pragma once

#include <memory>
#include <vector>

#include "cli/run/run.hpp"
#include "cli/system/atomic_file.hpp"
#include "engine/core/archive.hpp"
#include "engine/snapshot_blend.hpp"

namespace taut::cli {

/// A run at any time of its last step, which does not depend on it.
class LastStep {
 public:
  explicit LastStep(const Simulation& simulation) : simulation_(simulation) {}

  /// The step begins with the state at hand.
  void begin() { before_ = simulation_.snapshot(); }
  /// The particles at time `t` of a step that began with `begin`, or at its end. Valid until the next call.
  const Snapshot& at(double t);

 private:
  const Simulation& simulation_;
  Snapshot before_, shown_;
};

/// Something that a run shows of itself on its way. The steps of the run do not depend on it.
class RunOutput {
 public:
  virtual ~RunOutput() = default;
  RunOutput() = default;
  RunOutput(const RunOutput&) = delete;
  RunOutput& operator=(const RunOutput&) = delete;

  /// Its file; the folder belongs to the run by now. Throws OutputError, as all that writes does.
  virtual void open(AppendFile::Start) {}
  /// The next time that it shows, s; infinity when there is none.
  virtual double next() const = 0;
  /// Whether it shows its very times, between the steps, and not the first step at or past each of them.
  virtual bool is_at_its_time() const { return true; }
  /// Whether it is to show the state at hand too if the run ends with it, whatever its time.
  virtual bool lacks_the_end() const { return false; }
  /// Shows what is due, now that the first step at or past `next` is done. What it finds out goes into the
  /// run's result.
  virtual void take() = 0;
  /// Waits for what it does beside the run.
  virtual void settle() {}
  /// Waits until all that it has shown since the last call is on disk.
  virtual void put_on_disk() {}
  /// Brings the result up to date, before run.json is written.
  virtual void tell() {}
  /// Does what was put off until the run has ended. False if it was interrupted.
  virtual bool complete(const Interrupts&, Progress&) { return true; }

  /// All that changes as the run goes by, when it is settled. Loading touches no file.
  virtual void save(Saver& saver) = 0;
  virtual void load(Loader& loader) = 0;
  /// Takes back what the folder holds from after the saving of what was loaded.
  virtual void take_back() {}
};

/// All outputs of a run, in the order in which they take a state. `result` is theirs to write to; nothing
/// touches the folder yet. Throws SceneError for a line that leaves its body.
std::vector<std::unique_ptr<RunOutput>> make_outputs(const RunPlan& plan, const Simulation& simulation,
                                                     LastStep& last_step, RunResult& result);

}  // namespace taut::cli
