#pragma once

#include <span>
#include <string>

#include "engine/diagnostics/fields.hpp"

namespace taut::cli {

/// Extended XYZ with names of OVITO's manual ("XYZ file reader").
std::string extended_xyz_text(const Snapshot& snapshot, std::span<const Field* const> fields,
                              bool single_precision = false);

/// Header: "time [s],id,x [m],y [m]".
std::string particle_csv_text(const Snapshot& snapshot, std::span<const Field* const> fields,
                              bool single_precision = false);

}  // namespace taut::cli
