#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

/// Ids of particles that determine faces, ascending: in 2D see layout/outline.hpp, in 3D all without 26 lattice
/// neighbours.
std::vector<int> particles_at_faces(const Scene& scene, const InitialParticles& initial);

}  // namespace taut
