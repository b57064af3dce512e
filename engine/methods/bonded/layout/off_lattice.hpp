#pragma once

#include <vector>

#include <Eigen/Core>

#include "engine/layout/initial_particles.hpp"
#include "engine/methods/bonded/layout/constraints.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {

/// [body] (THEORY.md, Irregular bodies). `near` extends to at least 1.5 spacings.
std::vector<bool> irregular_bodies(const InitialParticles& initial, const Constraints& constraints,
                                   const NeighborLists& near, double spacing, int threads);

/// a_ij over X_ij as a function of dp/r (THEORY.md, Gradient); `even_share` is for irregular layouts.
double steep_share(double per_r);
double even_share(double per_r);

bool is_on_lattice(const std::vector<Eigen::Vector3d>& X, double spacing);

/// Whether a direction has no neighbour X within 60 degrees (2D: 50).
bool is_at_surface(const std::vector<Eigen::Vector2d>& X);
bool is_at_surface(const std::vector<Eigen::Vector3d>& X);

/// Maximum energy of the bonds over all strains, relative to the isotropic solid with λ = μ.
double excess(const std::vector<Eigen::Vector2d>& X, const std::vector<double>& w);
double excess(const std::vector<Eigen::Vector3d>& X, const std::vector<double>& w);

}  // namespace taut
