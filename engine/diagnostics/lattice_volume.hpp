#pragma once

#include <span>

#include "engine/snapshot.hpp"

namespace taut {

/// Volume in m^dim of the cells between the particles at positions `x` (n × dim, m); 0 unless the initial positions
/// form an axis-aligned lattice.
double lattice_volume(const Snapshot& now, int body, std::span<const double> x);

}  // namespace taut
