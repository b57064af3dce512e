#pragma once

#include <vector>

#include "engine/scene/shapes/round_shapes.hpp"

namespace taut {

// Aligned layers of particles in hollow round 3D bodies, arranged as in a cubic lattice, except at the corners of
// the cube that forms a hollow ball. The mass is exact; cube symmetries hold to the last bit.

std::vector<InitialSite> aligned_sites(const Ring& shell, double dp);
FacePatches aligned_patches(const Ring& shell, double dp);

std::vector<InitialSite> aligned_sites(const Cylinder& pipe, double dp);
FacePatches aligned_patches(const Cylinder& pipe, double dp);

}  // namespace taut
