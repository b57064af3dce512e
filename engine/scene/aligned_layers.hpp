#pragma once

#include <vector>

#include "engine/scene/shapes/round_shapes.hpp"

namespace taut {

// Layers of particles along the faces of hollow round 3D bodies. Each inner cell has six neighbours, as in a cubic
// lattice. The hollow ball is a cube mapped to a sphere, irregular only at the eight corners of the cube. The mass is
// exact, and the symmetries of the cube hold to the last bit.

std::vector<InitialSite> aligned_sites(const Ring& shell, double dp);
FacePatches aligned_patches(const Ring& shell, double dp);

std::vector<InitialSite> aligned_sites(const Cylinder& pipe, double dp);
FacePatches aligned_patches(const Cylinder& pipe, double dp);

}  // namespace taut
