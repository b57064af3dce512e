#pragma once

#include <filesystem>

#include "cli/run/plan.hpp"

namespace taut::cli {

/// Throws UsageError for other folders, and if nothing is left to do.
void check_resumable(const std::filesystem::path& folder, const RunOptions& given);

/// Plan that continues the run from its checkpoint, else from the start. `given` must agree with the folder, except
/// --threads, --keep-checkpoint, a later --until and a first --checkpoint-every. Without a checkpoint file, `given`
/// selects frames, particles and checkpoints. Throws UsageError and SceneError.
RunPlan resume_plan(const std::filesystem::path& folder, const RunOptions& given);

}  // namespace taut::cli
