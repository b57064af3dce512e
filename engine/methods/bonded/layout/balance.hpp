#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/methods/bonded/layout/bonds.hpp"

namespace taut {

/// Changes the a_ij, then the w_ij, of 2D bodies as little as possible, such that homogeneous strain leaves no force
/// inside (THEORY.md, Balance).
void balance(const InitialParticles& initial, const Constraints& constraints,
             const std::vector<bool>& irregular, Bonds& bonds, int threads);

}  // namespace taut
