#pragma once

#include <vector>

#include "engine/scene/scene.hpp"

namespace taut {

/// Replaces the lattice, near faces that it does not fit, by layers of particles ½, 1½ and 2½ spacings inside; then
/// Lloyd's algorithm moves the particles. Each has the volume of its Voronoi cell in the body. Departure from
/// [Zhu2021]: no level set and no pressure, which leave too few particles at faces. `box`: bounds of the body in
/// lattice coordinates, m.
void relax(std::vector<InitialSite>& sites, const Body& body, const Bounds& box, int dim, double dp);

}  // namespace taut
