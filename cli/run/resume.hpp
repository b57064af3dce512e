#pragma once

#include <filesystem>

#include "cli/run/plan.hpp"

namespace taut::cli {

/// Throws UsageError unless the folder is a run with work left.
void check_resumable(const std::filesystem::path& folder, const RunOptions& given);

/// Continues from the checkpoint, else from the start. Throws SceneError and UsageError.
RunPlan resume_plan(const std::filesystem::path& folder, const RunOptions& given);

}  // namespace taut::cli
