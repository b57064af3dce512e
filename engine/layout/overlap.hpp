#pragma once

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Of a particle in another body, of a face in a wall, spacings.
inline constexpr double greatest_depth = 0.25;

/// Throws SceneError, with the place, where two bodies overlap at the start: where particles are closer than
/// half a spacing, from which contact could not part them, or where one lies deeper than `greatest_depth` in the other
/// body, displaced as that may be, as those of a body inside another do.
void refuse_overlap(const InitialParticles& layout, const Scene& scene);

}  // namespace taut
