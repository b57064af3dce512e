#pragma once

#include <string>

#include "cli/run/run.hpp"

namespace taut::cli {

/// What `taut run` prints when a run has ended: the verdict, the measures beside their references, the speed
/// and where the output is.
std::string run_report(const RunPlan& plan, const RunResult& result);

/// What a run tells the shell. `fail_on`: the mildest verdict that fails; without it only divergence does.
int exit_code(const RunResult& result, const std::optional<Verdict>& fail_on = {});

}  // namespace taut::cli
