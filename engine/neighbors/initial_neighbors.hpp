#pragma once

#include <vector>

#include "engine/scene/initial_particles.hpp"

namespace taut {

/// The other particles of its own body nearer than `reach`, m, to each particle at the start: by id, in the
/// order of their ids.
std::vector<std::vector<int>> initial_neighbors(const InitialParticles& initial, double reach);

}  // namespace taut
