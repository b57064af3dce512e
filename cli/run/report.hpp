#pragma once

#include <string>

#include "cli/run/run.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/error.hpp"

namespace taut::cli {

/// Final text of `taut run`: measures with references, verdict, speed, output files.
std::string run_report(const RunPlan& plan, const RunResult& result);

/// Exit code of a run. `fail_on`: mildest failing verdict; without it, only divergence fails.
int exit_code(const RunResult& result, const std::optional<Verdict>& fail_on = {});

/// Message for a numerical error.
std::string describe_divergence(const NumericalError& error);
/// Message for a diverged state: its energy and fastest particle.
std::string describe_divergence(const Snapshot& now, const Balance& sums);

}  // namespace taut::cli
