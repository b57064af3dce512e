#pragma once

#include <vector>

#include "engine/scene/shapes/round_shapes.hpp"

namespace taut {

// Hollow round bodies in 3D in layers between their faces, with the same number of particles on each and all of a
// column on one line across the wall: every particle has its neighbours where a cubic lattice has them, but at the
// eight corners of the cube that a hollow ball is made of, where three faces meet. Each has the volume of its cell,
// so that the mass of the body is exact; places and volumes have the symmetries of the cube to the last bit.

std::vector<InitialSite> aligned_sites(const Ring& shell, double dp);
FacePatches aligned_patches(const Ring& shell, double dp);

std::vector<InitialSite> aligned_sites(const Cylinder& pipe, double dp);
FacePatches aligned_patches(const Cylinder& pipe, double dp);

}  // namespace taut
