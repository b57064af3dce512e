#pragma once

#include <string>
#include <vector>

#include "cli/run/saved_run.hpp"
#include "render/panel.hpp"

namespace taut::cli {

/// What is said about runs that are shown side by side.
struct RunLabels {
  std::string title, note;  // what all have in common: the scene, the method
  std::vector<render::Heading>
      columns;  // what tells each from the others: scene, method, parameters, spacing, constants
};

RunLabels label_runs(const std::vector<SavedRun>& runs);

/// "t = 1.5 ms": with as few decimals as tell all of the times exactly, in one unit.
std::vector<std::string> time_labels(const std::vector<double>& times, double until);

}  // namespace taut::cli
