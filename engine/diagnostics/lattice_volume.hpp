#pragma once

#include <span>

#include "engine/snapshot.hpp"

namespace taut {

/// Volume between particles at `x` (n × dim, m) of a body on an axis-aligned lattice, m^dim: sum of bi- or trilinear
/// cells. Ends at the outermost particles. 0 if there is no such lattice.
double lattice_volume(const Snapshot& now, int body, std::span<const double> x);

}  // namespace taut
