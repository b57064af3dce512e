#pragma once

#include <string>

#include "cli/scene/scene_file.hpp"

namespace taut::cli {

/// Checksum of the contents of all files that the scene names; empty without such files.
std::string file_checksum(const SceneFile& scene);

}  // namespace taut::cli
