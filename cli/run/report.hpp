#pragma once

#include <string>

#include "cli/run/run.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/error.hpp"

namespace taut::cli {

std::string run_report(const RunPlan& plan, const RunResult& result);

/// `fail_on`: mildest verdict that fails; default: divergence.
int exit_code(const RunResult& result, const std::optional<Verdict>& fail_on = {});

std::string describe_divergence(const NumericalError& error);
std::string describe_divergence(const Snapshot& now, const Balance& sums);

}  // namespace taut::cli
