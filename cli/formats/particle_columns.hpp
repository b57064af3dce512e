#pragma once

#include <span>
#include <string>

#include "engine/diagnostics/fields.hpp"

namespace taut::cli {

/// Extended XYZ for OVITO and ASE, with the property names of OVITO's manual ("XYZ file reader"): species (X), pos,
/// velo, disp, stress, strain, radius, id, mass. Tensors have OVITO's order xx, yy, zz, xy, xz, yz. The lattice is the
/// bounding box, not periodic. Scalars that a vector or tensor contains are left out.
std::string extended_xyz_text(const Snapshot& snapshot, std::span<const Field* const> fields,
                              bool single_precision = false);

/// CSV with a header such as "time [s],id,x [m],y [m]", one column per component, each once. In 2D without components
/// along z, except normal ones of tensors.
std::string particle_csv_text(const Snapshot& snapshot, std::span<const Field* const> fields,
                              bool single_precision = false);

}  // namespace taut::cli
