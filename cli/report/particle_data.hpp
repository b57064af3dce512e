#pragma once

#include <filesystem>
#include <optional>

#include "cli/text/json.hpp"

namespace taut::cli {

/// The saved particles of a run in 3D for a view that the reader can turn: times, a box, the colour scale and, per time
/// and particle, three 16-bit coordinates in the box and three 8-bit colours, base64. Uses the colours and the cut of
/// the run. None if the run is in 2D or has no saved particles. Leaves out times so that there are at most two million
/// particles in all. Throws UsageError for damaged files.
std::optional<Json> particle_data(const std::filesystem::path& run_folder);

}  // namespace taut::cli
