#pragma once

#include <filesystem>

#include "engine/scene/shapes/mesh.hpp"

namespace taut::cli {

/// Reads a closed mesh from an STL or OBJ file (libassimp), in the units of the file. Equal points are merged,
/// triangles without area are dropped. Throws UsageError if the file is unreadable, or the mesh is not closed.
Triangles read_mesh(const std::filesystem::path& file);

}  // namespace taut::cli
