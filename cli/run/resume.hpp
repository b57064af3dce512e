#pragma once

#include <filesystem>

#include "cli/run/plan.hpp"

namespace taut::cli {

/// Throws UsageError if the run cannot continue.
void check_goes_on(const std::filesystem::path& folder);

/// Continues the run in `folder` from its checkpoint, else from the start. Options `given` must agree with it, except
/// --threads; without a checkpoint file, they select frames, particles and checkpoints. Throws UsageError.
RunPlan resume_plan(const std::filesystem::path& folder, const RunOptions& given);

}  // namespace taut::cli
