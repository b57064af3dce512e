#pragma once

#include <filesystem>

#include "cli/run/plan.hpp"

namespace taut::cli {

/// Throws UsageError if the run cannot continue.
void check_resumable(const std::filesystem::path& folder, const RunOptions& given);

/// Plan that continues the run in `folder` from its checkpoint, else from the start. `given` are the options beside
/// --resume. They must agree with the folder, except --threads, --keep-checkpoint and a later --until. Without a
/// checkpoint file, they select frames, particles and checkpoints. Throws UsageError with the reason and a remedy.
RunPlan resume_plan(const std::filesystem::path& folder, const RunOptions& given);

}  // namespace taut::cli
