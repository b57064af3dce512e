#pragma once

#include <algorithm>

namespace taut::cli {

/// How far a run should go at a time so that it can be asked to stop about every fifth of a second, from the
/// speed it has shown so far.
class Pace {
 public:
  /// Starts with a millionth of the run (one step, as a rule): nothing is known of the speed yet.
  explicit Pace(double until) : slice_(1e-6 * until) {}

  double slice() const { return slice_; }  // s of the run
  void took(double run_time, double seconds) {
    const double wished = seconds > 0 ? 0.2 * run_time / seconds : 4 * slice_;
    slice_ = std::clamp(wished, slice_ / 4, 4 * slice_);
  }

 private:
  double slice_;
};

}  // namespace taut::cli
