#pragma once

#include <filesystem>

#include "engine/scene/shapes/mesh.hpp"

namespace taut::cli {

/// Reads a closed STL or OBJ mesh in file units. Throws UsageError.
Triangles read_mesh(const std::filesystem::path& file);

}  // namespace taut::cli
