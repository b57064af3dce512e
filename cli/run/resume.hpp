#pragma once

#include <filesystem>

#include "cli/run/plan.hpp"

namespace taut::cli {

/// Throws UsageError where there is no run in `folder` that could go on.
void check_goes_on(const std::filesystem::path& folder);

/// The plan of the run in `folder`: to go on from its checkpoint, or from the start where it was stopped
/// before the first. `given` are the options beside --resume: they must say what the folder says, but for the
/// number of threads; where there is no checkpoint at all, they decide about frames, particles and
/// checkpoints. Throws UsageError, with the reason and the way out, where that cannot be done.
RunPlan resume_plan(const std::filesystem::path& folder, const RunOptions& given);

}  // namespace taut::cli
