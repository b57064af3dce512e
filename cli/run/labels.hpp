#pragma once

#include <string>
#include <vector>

#include "cli/run/saved_run.hpp"
#include "render/panel.hpp"

namespace taut::cli {

struct RunLabels {
  std::string title, note;               // common to all runs
  std::vector<render::Heading> columns;  // differences of each run
};

RunLabels label_runs(const std::vector<SavedRun>& runs);

/// "t = 1.5 ms": the same unit and number of decimals for all times, at most four decimals.
std::vector<std::string> time_labels(const std::vector<double>& times, double until);

}  // namespace taut::cli
