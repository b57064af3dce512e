#pragma once

#include <vector>

#include <Eigen/Core>

#include "engine/layout/initial_particles.hpp"
#include "engine/methods/bonded/layout/constraints.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {

/// Returns for each body whether its layout is irregular: hardly any free particle has two equidistant neighbours, as in
/// a jittered body or a lattice written with six digits. `near`: neighbours within at least 1.5 spacings, by id.
std::vector<bool> irregular_bodies(const InitialParticles& initial, const Constraints& constraints,
                                   const NeighborLists& near, double spacing, int threads);

/// Return a_ij over X_ij as a function of dp/r (THEORY.md, Gradient). `steep_share` is for particles whose nearest
/// neighbours lie as on a lattice. `even_share` is for irregular layouts; it weights the first ring almost evenly.
double steep_share(double per_r);
double even_share(double per_r);

/// Returns whether the neighbours X of a particle have the distances of a cubic lattice.
bool is_on_lattice(const std::vector<Eigen::Vector3d>& X, double spacing);

/// Returns whether some direction has no neighbour X within 60 degrees (in 2D 50).
bool is_at_surface(const std::vector<Eigen::Vector2d>& X);
bool is_at_surface(const std::vector<Eigen::Vector3d>& X);

/// Returns the maximum, over all strains, of the energy of bonds X with weights w over the energy of the isotropic
/// solid with λ = μ.
double excess(const std::vector<Eigen::Vector2d>& X, const std::vector<double>& w);
double excess(const std::vector<Eigen::Vector3d>& X, const std::vector<double>& w);

}  // namespace taut
