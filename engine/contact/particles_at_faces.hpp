#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

/// The particles that faces move with, by id in rising order: in 2D those of layout/outline.hpp, in 3D those
/// that lack one of the 26 nearest of a cubic lattice.
std::vector<int> particles_at_faces(const Scene& scene, const InitialParticles& initial);

}  // namespace taut
