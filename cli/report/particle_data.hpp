#pragma once

#include <filesystem>
#include <optional>

#include "cli/text/json.hpp"

namespace taut::cli {

/// Times, box, colour scale and, as base64, three 16-bit coordinates and three 8-bit colour channels per particle.
/// Thins the times. Nullopt in 2D or without saved particles. Throws UsageError for damaged files.
std::optional<Json> particle_data(const std::filesystem::path& run_folder);

}  // namespace taut::cli
