#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Thickness of the particle layer `id` at a face of a body, m: the spacing, except in the layers of a round shape. In
/// an aligned pipe, a region within the end slices is a layer at the end faces.
double layer_thickness(const Body& body, const InitialParticles& initial, const std::vector<int>& id,
                       double spacing);

/// Mean depth of the loaded region `where` with the particles `id`, in layers per face of the body. 1 for the outermost
/// layer, below 1.35 on faces that cut the lattice (solver/THEORY.md). Infinite if no particle is near a face.
double layers_of_region(const Expression& where, const Body& body, const InitialParticles& initial,
                        const std::vector<int>& id, double thickness);

/// Throws SceneError if the region of a traction is 1.4 layers or more deep.
void refuse_deep_traction(const Load& load, const Body& body, double layers);

/// Throws SceneError for a traction on two faces that meet at an edge.
[[noreturn]] void refuse_edge(const Body& body);

}  // namespace taut
