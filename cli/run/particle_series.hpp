#pragma once

#include <vector>

#include "cli/run/folder.hpp"
#include "cli/system/stopwatch.hpp"
#include "engine/diagnostics/fields.hpp"

namespace taut::cli {

/// Saves the particles of a run: a file per time, whole as soon as it has its name, and an index of them all.
class ParticleSeries {
 public:
  /// The time it takes is added to `seconds`.
  ParticleSeries(std::vector<const Field*> fields, const RunFolder& folder, Seconds& seconds);

  void add(const Snapshot& snapshot);
  /// The index of the files that there are by now. Throws OutputError, as `add` does.
  void save_index();
  int written() const { return static_cast<int>(times_.size()); }
  /// Waits until all of them are on disk.
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
  std::size_t on_disk_ = 0;    // of the first files
  std::size_t indexed_ = 0;    // files, by this program
};

}  // namespace taut::cli
