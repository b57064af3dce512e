#pragma once

#include <vector>

#include <Eigen/Core>

#include "engine/neighbors/initial_neighbors.hpp"
#include "engine/scene/initial_particles.hpp"

namespace taut {

/// Of each body, whether its particles lie as in no row and no layer: hardly any free one has two others near it
/// that are equally far. So those of a jittered body lie, and of a lattice that was written with six digits; what
/// is held may have been laid otherwise. `near`: within 1.5 spacings at least, by id.
std::vector<bool> irregular_bodies(const InitialParticles& initial, const NeighborLists& near, double spacing,
                                   int threads);

/// a_ij over X_ij of the gradient (see bonds.hpp), of the spacing over r: the nearest count by far the most, which
/// is more exact where they are where those of a lattice are; all of the first ring of neighbours count about alike
/// where they lie as they like.
double steep_share(double per_r);
double even_share(double per_r);

/// Whether others that are X from a particle are where those of a cubic lattice are, by their distances.
bool on_lattice(const std::vector<Eigen::Vector3d>& X, double spacing);

/// Whether there is a direction within 60 degrees of which none of the others lies that are X from a particle; in
/// 2D within 50.
bool at_surface(const std::vector<Eigen::Vector2d>& X);
bool at_surface(const std::vector<Eigen::Vector3d>& X);

/// By how much bonds X of weights w are stiffer than an isotropic solid with λ = μ in the worst of all strains:
/// the greatest ratio of the two energies.
double excess(const std::vector<Eigen::Vector2d>& X, const std::vector<double>& w);
double excess(const std::vector<Eigen::Vector3d>& X, const std::vector<double>& w);

}  // namespace taut
