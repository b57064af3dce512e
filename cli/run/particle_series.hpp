#pragma once

#include <vector>

#include "cli/run/folder.hpp"
#include "cli/system/stopwatch.hpp"
#include "engine/diagnostics/fields.hpp"

namespace taut::cli {

/// Writes a file per time, atomically, and their index.
class ParticleSeries {
 public:
  /// Adds its time to `seconds`.
  ParticleSeries(std::vector<const Field*> fields, const RunFolder& folder, Seconds& seconds);

  void add(const Snapshot& snapshot);
  /// Throws OutputError, as `add`.
  void save_index();
  int written() const { return static_cast<int>(times_.size()); }
  void put_on_disk();

  template <class Archive>
  void serialize(Archive& archive) {
    archive(times_);
    on_disk_ = times_.size();
  }

 private:
  std::vector<const Field*> fields_;
  RunFolder folder_;
  Seconds& seconds_;
  std::vector<double> times_;  // s
  std::size_t on_disk_ = 0;
  std::size_t indexed_ = 0;
};

}  // namespace taut::cli
