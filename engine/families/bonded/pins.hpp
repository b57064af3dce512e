#pragma once

#include <vector>

#include "engine/scene/initial_particles.hpp"

namespace taut {

/// Held particles about which their body can turn: in 2D one that has no other held one beside it, in 3D those of
/// one row. They are no clamp, whose face bonds end at (bonds.hpp): a block of the size of a particle, rigid and built
/// into the body, resists a turn by some 0.02 E dp². A pin is a particle of the body like any other, but for its
/// place. By id, rising.
std::vector<int> pins(const InitialParticles& initial, double spacing);

}  // namespace taut
