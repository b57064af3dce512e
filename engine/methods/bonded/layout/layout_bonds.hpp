#pragma once

#include "engine/methods/bonded/layout/bonds.hpp"

namespace taut {

/// Returns balanced bonds of 2D bodies. They do not end at clamps yet and have no volumes and masses. No two
/// particles share a row. Lengths in m.
Bonds layout_bonds(const InitialParticles& initial, const Constraints& constraints, double spacing, double h,
                   int threads);

}  // namespace taut
