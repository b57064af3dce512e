#pragma once

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Allowed depth of particles in another body or of faces in walls, in spacings.
inline constexpr double greatest_depth = 0.25;

/// Throws SceneError if particles (not nodes of elements) of two bodies start less than half a spacing apart, or if
/// particles start deeper than `greatest_depth` in another body.
void refuse_overlap(const InitialParticles& layout, const Scene& scene);

}  // namespace taut
