#pragma once

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "engine/snapshot.hpp"

namespace taut {

/// The series of a scene's probes: one row per step.
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

/// A running simulation. Virtual calls are for whole stretches of it, never within a step.
class Simulation {
 public:
  virtual ~Simulation() = default;

  /// Steps until the first step at or past time `t` (never cut short: output does not alter a run). Throws
  /// NumericalError when a value is no longer finite; `snapshot` is the last one taken before, then.
  void advance_to(double t) { advance(t, std::numeric_limits<double>::infinity()); }
  /// The same, but makes no step that ends at or past `short_of`: the state at hand is then the last one
  /// before that time, or `t` is reached.
  virtual void advance(double t, double short_of) = 0;
  /// From now on `advance` makes no step while `stop`, which outlives the simulation, is not 0: a signal or
  /// another thread ends it after the step at hand, however many are still to go.
  void heed(const std::atomic<int>& stop) { stop_ = &stop; }

  /// All that its next steps depend on, and the series so far, as bytes for `load`.
  virtual std::string save() = 0;
  /// Goes on where another simulation of the same scene and settings was saved, in this program on this kind
  /// of machine: the next steps give the same bytes. Throws UsageError for a state that is not one of those; the
  /// simulation is of no use then. No state, damaged or made up, makes later steps reach foreign memory.
  virtual void load(std::string_view state) = 0;

  /// The particles now. Made when it is first asked for, from what the next steps make anew, so that nothing
  /// they depend on is altered.
  const Snapshot& snapshot() const {
    if (outdated_) const_cast<Simulation*>(this)->renew_snapshot();
    return snapshot_;
  }
  const Series& series() const { return series_; }
  double time() const { return time_; }  // s
  long steps() const { return step_; }
  /// Directed pairs of neighbours, as of the last rebuild.
  long pairs() const { return pairs_; }
  double support() const { return support_; }  // radius of interaction, m
  /// The neighbours of a particle inside its body are those of the start.
  bool keeps_neighbors() const { return keeps_neighbors_; }
  /// Of two particles beside each other, up to which the method follows its law of elasticity.
  double lawful_stretch() const { return lawful_stretch_; }
  /// Greatest number of threads in use.
  int threads() const { return threads_; }

 protected:
  virtual void take_snapshot() = 0;  // into snapshot_
  bool asked_to_stop() const { return stop_->load(std::memory_order_relaxed) != 0; }

  Snapshot snapshot_;
  bool outdated_ = true;  // snapshot_
  double time_ = 0;       // s
  long step_ = 0;
  Series series_;
  long pairs_ = 0;
  double support_ = 0;
  bool keeps_neighbors_ = false;
  double lawful_stretch_ = std::numeric_limits<double>::infinity();
  int threads_ = 1;

 private:
  static inline const std::atomic<int> never_{0};

  void renew_snapshot() {
    take_snapshot();
    outdated_ = false;
  }

  const std::atomic<int>* stop_ = &never_;
};

}  // namespace taut
