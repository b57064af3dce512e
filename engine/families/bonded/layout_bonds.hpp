#pragma once

#include "engine/families/bonded/bonds.hpp"

namespace taut {

/// In 2D, balanced, as if nothing were held; without volumes and masses. No two particles share a row. Lengths in m.
Bonds layout_bonds(const InitialParticles& initial, double spacing, double h, int threads);

}  // namespace taut
