#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

/// Ids, ascending: in 2D the particles of the nodes of layout/outline.hpp, in 3D particles with fewer than 26
/// neighbours within 1.8 spacings, in a mesh the nodes on its boundary.
std::vector<int> particles_at_faces(const Scene& scene, const InitialParticles& initial);

}  // namespace taut
