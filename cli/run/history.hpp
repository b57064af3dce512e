#pragma once

#include <string>
#include <vector>

#include "cli/system/atomic_file.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/indicators.hpp"
#include "engine/simulation.hpp"

namespace taut::cli {

/// history.csv: a row per history time, in SI units. Each row is complete in the file as soon as it is made.
class History {
 public:
  /// Anew, or to go on with the file of a run that is to be loaded.
  History(const std::filesystem::path& path, const Scene& scene,
          AppendFile::Start start = AppendFile::Start::empty);

  /// A row for the state at hand, unless the last row shows this very step.
  void add(const Simulation& simulation, const Balance& balance, int pieces, const Readings& readings);

  /// Loading takes back the rows that were written after this was saved.
  template <class Archive>
  void serialize(Archive& archive) {
    std::int64_t length = file_.length();
    archive(length, last_step_);
    file_.cut(length);
  }

 private:
  AppendFile file_;
  int dim_;
  bool works_, damps_;  // something from outside does work, the scene is damped
  long last_step_ = -1;
};

}  // namespace taut::cli
