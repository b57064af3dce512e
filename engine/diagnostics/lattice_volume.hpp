#pragma once

#include <span>

#include "engine/snapshot.hpp"

namespace taut {

/// Volume between the particles of an axis-aligned lattice at `x` (n × dim, m), m^dim, by bi- or trilinear cells; 0
/// for other bodies.
double lattice_volume(const Snapshot& now, int body, std::span<const double> x);

}  // namespace taut
