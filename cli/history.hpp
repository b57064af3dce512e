#pragma once

#include <string>
#include <vector>

#include "cli/whole_file.hpp"
#include "engine/indicators.hpp"
#include "engine/simulation.hpp"

namespace taut {

/// history.csv: a row per history time, in SI units. Each row is complete in the file as soon as it is made.
class History {
 public:
  History(const std::filesystem::path& path, const Scene& scene);

  /// A row for the state at hand, unless the last row shows this very step.
  void add(const Simulation& simulation, const Balance& balance, int pieces, const Readings& readings);

 private:
  LineFile file_;
  int dim_;
  bool driven_;
  long last_step_ = -1;
};

}  // namespace taut
