#pragma once

#include <vector>

#include <Eigen/Core>

#include "engine/layout/initial_particles.hpp"
#include "engine/methods/bonded/layout/constraints.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {

/// True for bodies in which hardly any free particle has two neighbours at equal distance. `near`: within at least
/// 1.5 spacings, by id.
std::vector<bool> irregular_bodies(const InitialParticles& initial, const Constraints& constraints,
                                   const NeighborLists& near, double spacing, int threads);

/// a_ij over X_ij as a function of dp/r (THEORY.md, Gradient): steep for lattices, even for irregular layouts.
double steep_share(double per_r);
double even_share(double per_r);

/// True if the neighbour distances are those of a cubic lattice.
bool is_on_lattice(const std::vector<Eigen::Vector3d>& X, double spacing);

/// True if no neighbour lies within 60 degrees (2D: 50) of some direction.
bool is_at_surface(const std::vector<Eigen::Vector2d>& X);
bool is_at_surface(const std::vector<Eigen::Vector3d>& X);

/// Maximum, over all strains, of the energy of bonds X with weights w relative to the isotropic solid with λ = μ.
double excess(const std::vector<Eigen::Vector2d>& X, const std::vector<double>& w);
double excess(const std::vector<Eigen::Vector3d>& X, const std::vector<double>& w);

}  // namespace taut
