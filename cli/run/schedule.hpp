#pragma once

#include <vector>

namespace taut::cli {

/// 0, until/parts, … until.
std::vector<double> times_in_parts(double until, int parts);
/// 0, interval, 2·interval, … as long as they are not past `until`.
std::vector<double> times_every(double until, double interval);

/// Output times that are ticked off as a run goes by.
class Agenda {
 public:
  explicit Agenda(std::vector<double> times) : times_(std::move(times)) {}

  /// The next time not reached yet; infinity when there is none.
  double next() const;
  /// How many times have been reached by `now` since the last call.
  int reached(double now);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(done_);
  }

 private:
  std::vector<double> times_;  // s, sorted
  std::size_t done_ = 0;
};

}  // namespace taut::cli
