#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/methods/bonded/layout/bonds.hpp"

namespace taut {

/// See THEORY.md, Balance.
void balance(const InitialParticles& initial, const Constraints& constraints,
             const std::vector<bool>& irregular, Bonds& bonds, int threads);

}  // namespace taut
