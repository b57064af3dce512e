#pragma once

#include <span>

#include "engine/snapshot.hpp"

namespace taut {

/// Volume of what lies between the particles of a body at places `x`, n × dim, m^dim: of the squares or cubes
/// of the lattice along the axes that they were laid on, each a (bi- or trilinear) map of its corners,
/// whatever a method takes its density for. In a body whose particles stand on its faces that is all of it,
/// else what the centres of the outermost cells enclose. 0 of a body that is no such lattice.
double lattice_volume(const Snapshot& now, int body, std::span<const double> x);

}  // namespace taut
