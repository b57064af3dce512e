#pragma once

#include <string>

#include "cli/run/run.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/error.hpp"

namespace taut::cli {

/// Text that `taut run` prints at the end: measures with their references, verdict, speed and the output files.
std::string run_report(const RunPlan& plan, const RunResult& result);

/// Exit code of a run. `fail_on`: the mildest verdict that fails; without it only divergence does.
int exit_code(const RunResult& result, const std::optional<Verdict>& fail_on = {});

/// Message for a run that ended in an error of the solver.
std::string describe_divergence(const NumericalError& error);
/// Message for a state that was judged to have diverged: its energy and its fastest particle.
std::string describe_divergence(const Snapshot& now, const Balance& sums);

}  // namespace taut::cli
