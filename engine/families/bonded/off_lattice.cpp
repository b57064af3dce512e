#include "engine/families/bonded/off_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

namespace taut {
namespace {

/// Evenly, about 15 degrees apart.
std::vector<Eigen::Vector3d> make_directions() {
  std::vector<Eigen::Vector3d> all;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z)
        if (x % 2 != 0 || y % 2 != 0 || z % 2 != 0) all.push_back(Eigen::Vector3d(x, y, z).normalized());
  return all;
}

}  // namespace

bool on_lattice(const std::vector<Eigen::Vector3d>& X, double spacing) {
  constexpr double alike = 1e-3;
  return std::ranges::all_of(X, [&](const Eigen::Vector3d& one) {
    const double r2 = one.squaredNorm() / (spacing * spacing);
    return std::abs(r2 - std::round(r2)) < alike;
  });
}

bool at_surface(const std::vector<Eigen::Vector3d>& X) {
  static const std::vector<Eigen::Vector3d> directions = make_directions();
  constexpr double cosine = 0.5;  // of 60 degrees
  return std::ranges::any_of(directions, [&](const Eigen::Vector3d& d) {
    return std::ranges::none_of(X,
                                [&](const Eigen::Vector3d& one) { return one.dot(d) > cosine * one.norm(); });
  });
}

double excess(const std::vector<Eigen::Vector3d>& X, const std::vector<double>& w) {
  using Six = Eigen::Matrix<double, 6, 6>;
  Six ratio = Six::Zero();  // in the basis in which the isotropic solid has 1
  for (std::size_t b = 0; b < X.size(); ++b) {
    const Eigen::Vector3d e = X[b].normalized();
    const double dilation = 1 / (3 * std::sqrt(5.0)), shear = 1 / std::numbers::sqrt2;
    const Eigen::Vector<double, 6> of_bond{(e[0] * e[0] - 1.0 / 3) * shear + dilation,
                                           (e[1] * e[1] - 1.0 / 3) * shear + dilation,
                                           (e[2] * e[2] - 1.0 / 3) * shear + dilation,
                                           e[1] * e[2],
                                           e[0] * e[2],
                                           e[0] * e[1]};
    ratio += w[b] * of_bond * of_bond.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Six>(ratio, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace taut
