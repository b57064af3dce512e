#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace taut::cli {

/// 0, until/parts, … until.
std::vector<double> times_in_parts(double until, int parts);
/// 0, interval, 2·interval, … up to `until`.
std::vector<double> times_every(double until, double interval);

class Agenda {
 public:
  explicit Agenda(std::vector<double> times) : times_(std::move(times)) {}

  /// Next time not reached, or infinity.
  double next() const;
  /// Times up to `now` not returned before.
  std::span<const double> reached(double now);
  std::size_t done() const { return done_; }
  void skip_to(double now);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(done_);
    archive.check("the number of times reached", [&] { return done_ <= times_.size(); });
  }

 private:
  std::vector<double> times_;  // s, sorted
  std::size_t done_ = 0;
};

/// Slices of about 0.2 s of wall clock.
class Pace {
 public:
  explicit Pace(double until) : slice_(1e-6 * until) {}

  double slice() const { return slice_; }  // simulated time, s
  void took(double run_time, double seconds) {
    const double wished = seconds > 0 ? 0.2 * run_time / seconds : 4 * slice_;
    slice_ = std::clamp(wished, slice_ / 4, 4 * slice_);
  }

 private:
  double slice_;
};

}  // namespace taut::cli
