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

/// "t = 1.5 ms", with the same unit and number of decimals, at most four, for all times.
std::vector<std::string> time_labels(const std::vector<double>& times, double until);

}  // namespace taut::cli
