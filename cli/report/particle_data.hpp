#pragma once

#include <filesystem>
#include <optional>

#include "cli/text/json.hpp"

namespace taut::cli {

/// Saved 3D particles for a view that can turn: times, box, colour scale, and as base64 three 16-bit coordinates and
/// three 8-bit colours per particle. Nullopt in 2D or without saved particles. Thins the times if they have more than
/// two million particles in total. Throws UsageError for damaged files.
std::optional<Json> particle_data(const std::filesystem::path& run_folder);

}  // namespace taut::cli
