#pragma once

#include "engine/methods/bonded/layout/bonds.hpp"

namespace taut {

/// Bonds in 2D, not yet cut at clamps, without volumes and masses. Lengths in m.
Bonds layout_bonds(const InitialParticles& initial, const Constraints& constraints, double spacing, double h,
                   int threads);

}  // namespace taut
