#pragma once

#include <vector>

#include <Eigen/Core>

#include "engine/layout/initial_particles.hpp"
#include "engine/methods/bonded/layout/constraints.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {

/// Returns for each body whether its layout is irregular: hardly any free particle has two neighbours at the same
/// distance, as in a jittered body or a lattice written with six digits. `near`: within at least 1.5 spacings, by id.
std::vector<bool> irregular_bodies(const InitialParticles& initial, const Constraints& constraints,
                                   const NeighborLists& near, double spacing, int threads);

/// Return a_ij over X_ij as a function of dp/r (THEORY.md, Gradient): steep where the nearest lie as on a lattice;
/// even, so that the first ring counts about equally, on irregular layouts.
double steep_share(double per_r);
double even_share(double per_r);

/// Returns whether the neighbours X of a particle lie at the distances of a cubic lattice.
bool is_on_lattice(const std::vector<Eigen::Vector3d>& X, double spacing);

/// Returns whether there is a direction without neighbours X within 60 degrees of it, in 2D within 50.
bool is_at_surface(const std::vector<Eigen::Vector2d>& X);
bool is_at_surface(const std::vector<Eigen::Vector3d>& X);

/// Returns the greatest ratio, over all strains, of the energy of bonds X with weights w to the energy of an isotropic
/// solid with λ = μ.
double excess(const std::vector<Eigen::Vector2d>& X, const std::vector<double>& w);
double excess(const std::vector<Eigen::Vector3d>& X, const std::vector<double>& w);

}  // namespace taut
