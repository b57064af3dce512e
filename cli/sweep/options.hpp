#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/run/plan.hpp"
#include "cli/sweep/plan.hpp"

namespace taut::cli {

struct SweepOptions {
  std::string what;  // file or scene
  std::vector<std::string> grid;
  RunOptions run;
  std::optional<std::string> emit, fail_on;
  std::optional<int> jobs, index, repeat;
  bool list = false, force = false, render = false, quiet = false;
};

void declare_sweep_options(Options& command, SweepOptions& options);

/// Throws UsageError and SceneError.
SweepRequest make_request(const SweepOptions& options);

/// Words of the command without options for a single call (--list). An option and its value are one word.
std::vector<std::string> command_to_repeat(const Options& command);

}  // namespace taut::cli
