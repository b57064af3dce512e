#pragma once

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "engine/snapshot.hpp"

namespace taut {

struct Series {
  std::vector<double> time;                // s
  std::vector<std::vector<double>> value;  // [probe][step]

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time);
    archive.fixed(value);
    archive.check("a series", [&] {
      const auto stand_still = [](double before, double after) { return !(before < after); };
      return std::adjacent_find(time.begin(), time.end(), stand_still) == time.end() &&
             std::all_of(value.begin(), value.end(),
                         [&](const std::vector<double>& of_probe) { return of_probe.size() == time.size(); });
    });
  }
};

struct RunState {
  double time = 0;  // s
  long steps = 0;
  Series series;
  long pairs = 0;                // directed neighbour pairs, or nodes of all elements
  double support = 0;            // radius of interaction, m
  bool keeps_neighbors = false;  // particles of a body keep their initial neighbours
  /// Greatest stretch of a neighbour pair at which the method follows its elastic law.
  double lawful_stretch = std::numeric_limits<double>::infinity();
  int threads = 1;  // greatest number in use
};

class Simulation {
 public:
  virtual ~Simulation() = default;

  /// Advances to the first step that ends at or past `t` (in s). Never shortens a step, so that output does not alter a
  /// run. Throws NumericalError if the run diverges.
  void advance_to(double t) { advance(t, std::numeric_limits<double>::infinity()); }
  /// Like `advance_to`, but makes no step that ends at or past `short_of` (in s).
  virtual void advance(double t, double short_of) = 0;
  /// Makes `advance` return after the current step once `stop` is not 0. `stop` must outlive the simulation.
  void set_stop_flag(const std::atomic<int>& stop) { stop_ = &stop; }

  virtual std::string save() = 0;
  /// Continues from a state of the same scene and settings. Throws UsageError for any other state; the simulation is
  /// then unusable. Damaged states cause no access outside arrays.
  virtual void load(std::string_view state) = 0;

  /// State after the last step. After a NumericalError: the last snapshot taken before it, if any.
  const Snapshot& snapshot() const {
    if (outdated_) take_snapshot(snapshot_);
    outdated_ = false;
    return snapshot_;
  }
  /// Snapshot with current positions, velocities, masses and energies; other fields may be empty.
  const Snapshot& motion() const { return outdated_ && take_motion(motion_) ? motion_ : snapshot(); }
  const Series& series() const { return run_state().series; }
  double time() const { return run_state().time; }  // s
  long steps() const { return run_state().steps; }
  long pairs() const { return run_state().pairs; }
  double support() const { return run_state().support; }  // m
  bool keeps_neighbors() const { return run_state().keeps_neighbors; }
  double lawful_stretch() const { return run_state().lawful_stretch; }
  int threads() const { return run_state().threads; }

 protected:
  virtual const RunState& run_state() const = 0;
  virtual void take_snapshot(Snapshot& out) const = 0;
  /// Returns false if energies depend on stresses.
  virtual bool take_motion(Snapshot& /*out*/) const { return false; }
  bool asked_to_stop() const { return stop_->load(std::memory_order_relaxed) != 0; }
  bool has_snapshot() const { return !snapshot_.m.empty(); }

  mutable Snapshot snapshot_;
  mutable bool outdated_ = true;

 private:
  static inline const std::atomic<int> never_{0};

  mutable Snapshot motion_;
  const std::atomic<int>* stop_ = &never_;
};

}  // namespace taut
