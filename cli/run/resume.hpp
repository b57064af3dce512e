#pragma once

#include <filesystem>

#include "cli/run/run.hpp"

namespace taut::cli {

/// The plan of the run in `folder`, to go on from its checkpoint as its scene.toml says. Throws UsageError,
/// with the reason and the way out, where that cannot be done.
RunPlan resume_plan(const std::filesystem::path& folder, int threads);

}  // namespace taut::cli
