#pragma once

#include <string>

#include "cli/run.hpp"

namespace taut {

/// What `taut run` prints when a run has ended: the verdict, the measures beside their references, the speed
/// and where the output is.
std::string run_report(const RunPlan& plan, const RunResult& result);

}  // namespace taut
