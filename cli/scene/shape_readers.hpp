#pragma once

#include <filesystem>

#include "cli/scene/sections.hpp"
#include "engine/scene/shapes/box.hpp"

namespace taut::cli {

Shape read_polygon(TomlCursor& shape, const ShapeSetting& setting);
Shape read_ellipse(TomlCursor& shape, const ShapeSetting& setting);
Shape read_expression(TomlCursor& shape, const ShapeSetting& setting);
Shape read_particles(TomlCursor& shape, const ShapeSetting& setting);
Shape read_svg(TomlCursor& shape, const ShapeSetting& setting);
Shape read_mesh_file(TomlCursor& shape, const ShapeSetting& setting);
Shape read_mask_file(TomlCursor& shape, const ShapeSetting& setting);

/// Throws SceneError unless low < high.
Box read_low_and_high(TomlCursor& shape, int dim);

}  // namespace taut::cli
