#pragma once

#include <vector>

#include "engine/scene/scene.hpp"

namespace taut {

/// Arranges the particles of a lattice along the faces of their body. Near faces that the lattice does not fit,
/// layers of particles ½, 1½ and 2½ spacings inside replace the lattice; then Lloyd's algorithm moves the particles.
/// Each particle has the volume of its Voronoi cell in the body. Departure from [Zhu2021]: no level set and no
/// pressure, which leave too few particles at faces. `box`: bounds of the body in lattice coordinates, m.
void relax(std::vector<InitialSite>& sites, const Body& body, const Bounds& box, int dim, double dp);

}  // namespace taut
