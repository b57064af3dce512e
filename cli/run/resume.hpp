#pragma once

#include <filesystem>

#include "cli/run/plan.hpp"

namespace taut::cli {

/// Throws UsageError if `folder` has no run that can continue.
void check_goes_on(const std::filesystem::path& folder);

/// Plan to continue the run in `folder` from its checkpoint, or from the start if there is none. Options `given`
/// beside --resume must agree with the folder, except --threads. Without a checkpoint file, they select frames,
/// particles and checkpoints. Throws UsageError with reason and remedy.
RunPlan resume_plan(const std::filesystem::path& folder, const RunOptions& given);

}  // namespace taut::cli
