#pragma once

#include <iosfwd>
#include <string>

#include "cli/run/run.hpp"

namespace taut::cli {

/// Reports size, step, estimated time and memory after a few steps. Writes the first frame, if any, beside the run
/// folder. Throws NumericalError.
std::string dry_run(const RunPlan& plan, std::ostream& err);

}  // namespace taut::cli
