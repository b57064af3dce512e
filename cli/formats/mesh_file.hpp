#pragma once

#include <filesystem>

#include "engine/scene/shapes/mesh.hpp"

namespace taut::cli {

/// Reads a closed STL or OBJ mesh in file units. Merges equal points, drops triangles with two equal corners.
/// Throws UsageError.
Triangles read_mesh(const std::filesystem::path& file);

}  // namespace taut::cli
