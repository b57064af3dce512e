#pragma once

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
    archive(time, value);
  }
};

/// A running simulation. Virtual calls are for whole stretches of it, never within a step.
class Simulation {
 public:
  virtual ~Simulation() = default;

  /// Steps until the first step at or past time `t` (never cut short: output does not alter a run), then
  /// refreshes `snapshot`. Throws NumericalError when a value is no longer finite.
  virtual void advance_to(double t) = 0;

  /// All that its next steps depend on, and the series so far, as bytes for `load`.
  virtual std::string save() = 0;
  /// Goes on where another simulation of the same scene and settings was saved, in this program on this kind
  /// of machine: the next steps give the same bytes. Throws UsageError for a state that is not one of those.
  virtual void load(std::string_view state) = 0;

  const Snapshot& snapshot() const { return snapshot_; }
  const Series& series() const { return series_; }
  double time() const { return snapshot_.time; }
  long steps() const { return snapshot_.step; }
  /// Directed pairs of neighbours, as of the last rebuild.
  long pairs() const { return pairs_; }
  double support() const { return support_; }  // radius of interaction, m
  /// Greatest number of threads in use.
  int threads() const { return threads_; }

 protected:
  Snapshot snapshot_;
  Series series_;
  long pairs_ = 0;
  double support_ = 0;
  int threads_ = 1;
};

}  // namespace taut
