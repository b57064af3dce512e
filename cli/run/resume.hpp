#pragma once

#include <filesystem>

#include "cli/run/plan.hpp"

namespace taut::cli {

/// Throws UsageError if `folder` has no run that can continue.
void check_goes_on(const std::filesystem::path& folder);

/// Continues the run in `folder` from its checkpoint, or from the start without one. Options `given` must agree with
/// the run, except --threads; without a checkpoint file, they select frames, particles and checkpoints. Throws
/// UsageError with the remedy.
RunPlan resume_plan(const std::filesystem::path& folder, const RunOptions& given);

}  // namespace taut::cli
