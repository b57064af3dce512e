#pragma once

#include <vector>

#include "engine/scene/shapes/round_shapes.hpp"

namespace taut {

// Layers of particles along the faces of hollow round 3D bodies.

std::vector<InitialSite> aligned_sites(const Ring& shell, double dp);
FacePatches aligned_patches(const Ring& shell, double dp);

std::vector<InitialSite> aligned_sites(const Cylinder& pipe, double dp);
FacePatches aligned_patches(const Cylinder& pipe, double dp);

}  // namespace taut
