#pragma once

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Of a particle in another body, or of a face in a wall, spacings.
inline constexpr double greatest_depth = 0.25;

/// Throws SceneError if bodies overlap at the start: particles are less than half a spacing apart, which contact
/// could not separate, or deeper than `greatest_depth` in another body.
void refuse_overlap(const InitialParticles& layout, const Scene& scene);

}  // namespace taut
