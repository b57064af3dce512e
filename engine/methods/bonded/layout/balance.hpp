#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/methods/bonded/layout/bonds.hpp"

namespace taut {

/// Balances a_ij, then w_ij, in 2D (THEORY.md, Balance).
void balance(const InitialParticles& initial, const Constraints& constraints,
             const std::vector<bool>& irregular, Bonds& bonds, int threads);

}  // namespace taut
