#pragma once

#include <vector>

#include <Eigen/Core>

namespace taut {

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
