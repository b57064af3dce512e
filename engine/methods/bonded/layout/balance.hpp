#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/methods/bonded/layout/bonds.hpp"

namespace taut {

/// Balances the bonds inside 2D bodies (THEORY.md, Balance). `irregular`: [body].
void balance(const InitialParticles& initial, const Constraints& constraints,
             const std::vector<bool>& irregular, Bonds& bonds, int threads);

}  // namespace taut
