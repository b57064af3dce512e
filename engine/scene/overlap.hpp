#pragma once

#include "engine/scene/initial_particles.hpp"

namespace taut {

/// Throws SceneError, with the place, where two bodies overlap at the start: where particles are closer than
/// half a spacing, from which contact could not part them, or where one lies deeper than a quarter of a
/// spacing in the other body, as those of a body inside another do. The latter of bodies that start as they
/// are laid.
void refuse_overlap(const InitialParticles& layout, const Scene& scene);

}  // namespace taut
