#pragma once

#include <span>

#include "engine/snapshot.hpp"

namespace taut {

/// Volume of a body on an axis-aligned lattice with particles at positions `x` (n × dim, m), m^dim: the sum over its
/// squares or cubes, each a bilinear or trilinear map. Covers the whole body if its particles lie on the faces, else
/// up to the centres of the outermost cells. 0 if the body has no such lattice.
double lattice_volume(const Snapshot& now, int body, std::span<const double> x);

}  // namespace taut
