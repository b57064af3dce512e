#include "engine/methods/bonded/layout/off_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <Eigen/Eigenvalues>

#include "engine/core/parallel.hpp"
#include "engine/core/point.hpp"

namespace taut {
namespace {

/// Unit vectors; any direction is within 18 degrees of one.
std::vector<Eigen::Vector3d> make_directions() {
  std::vector<Eigen::Vector3d> all;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z)
        if (x % 2 != 0 || y % 2 != 0 || z % 2 != 0) all.push_back(Eigen::Vector3d(x, y, z).normalized());
  return all;
}

/// Maximum eigenvalue of the bonds' energy in a basis where the isotropic solid is the identity.
template <int Strains, int Dim, class OfBond>
double greatest_ratio(const std::vector<Eigen::Vector<double, Dim>>& X, const std::vector<double>& w,
                      const OfBond& of_bond) {
  using Square = Eigen::Matrix<double, Strains, Strains>;
  Square ratio = Square::Zero();
  for (std::size_t b = 0; b < X.size(); ++b) {
    const Eigen::Vector<double, Strains> one = of_bond(X[b].normalized());
    ratio += w[b] * one * one.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Square>(ratio, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

bool has_equal_neighbors(const InitialParticles& initial, std::span<const int> near, int i, double spacing) {
  constexpr double alike = 1e-11, farthest = 1.5;  // in spacings
  constexpr double ulps = 8;                       // of coordinates
  const Point& at = initial.x[i];
  double greatest = 0;
  for (const double coordinate : at) greatest = std::max(greatest, std::abs(coordinate));
  const double tolerance = alike * spacing + ulps * 0x1p-52 * greatest;
  std::vector<double> r;
  r.reserve(near.size());
  for (const int j : near)
    if (const double one = distance_between(initial.x[j], at, initial.dim); one < farthest * spacing)
      r.push_back(one);
  std::ranges::sort(r);
  return std::ranges::adjacent_find(r, [&](double a, double b) { return b - a < tolerance; }) != r.end();
}

}  // namespace

std::vector<bool> irregular_bodies(const InitialParticles& initial, const Constraints& constraints,
                                   const NeighborLists& near, double spacing, int threads) {
  std::vector<unsigned char> regular(initial.size());
  parallel_for(initial.size(), threads, [&](int i) {
    regular[i] = is_rigid(constraints[i]) || has_equal_neighbors(initial, near[i], i, spacing);
  });
  std::vector<bool> irregular;
  for (std::size_t body = 0; body + 1 < initial.first.size(); ++body) {
    const int first = initial.first[body], end = initial.first[body + 1];
    const auto rigid = std::count_if(&constraints[first], &constraints[first] + (end - first), is_rigid);
    const auto free = end - first - rigid,
               equal = std::count(&regular[first], &regular[first] + (end - first), 1) - rigid;
    const bool relaxed = initial.dim == 2 && !initial.relaxed.empty() && initial.relaxed[body];
    // in layered balls only half of the particles have equal neighbours
    irregular.push_back(relaxed || (initial.dim == 3 ? 10 : 2) * equal < free);
  }
  return irregular;
}

double steep_share(double per_r) {
  const double squared = per_r * per_r, to_4 = squared * squared;
  return to_4 * to_4;
}

double even_share(double per_r) {
  constexpr double reach_of_nearest = 1.3;  // in spacings
  return 1 / (1 + 1 / steep_share(reach_of_nearest * per_r));
}

bool is_on_lattice(const std::vector<Eigen::Vector3d>& X, double spacing) {
  constexpr double alike = 1e-3;
  return std::ranges::all_of(X, [&](const Eigen::Vector3d& one) {
    const double r2 = one.squaredNorm() / (spacing * spacing);
    return std::abs(r2 - std::round(r2)) < alike;
  });
}

bool is_at_surface(const std::vector<Eigen::Vector2d>& X) {
  constexpr double widest = 100 * std::numbers::pi / 180;
  if (X.size() < 3) return true;
  std::vector<double> angle;
  angle.reserve(X.size());
  for (const Eigen::Vector2d& one : X) angle.push_back(std::atan2(one[1], one[0]));
  std::ranges::sort(angle);
  double gap = angle.front() + 2 * std::numbers::pi - angle.back();
  for (std::size_t k = 1; k < angle.size(); ++k) gap = std::max(gap, angle[k] - angle[k - 1]);
  return gap > widest;
}

bool is_at_surface(const std::vector<Eigen::Vector3d>& X) {
  static const std::vector<Eigen::Vector3d> directions = make_directions();
  constexpr double cosine = 0.5;  // of 60 degrees
  return std::ranges::any_of(directions, [&](const Eigen::Vector3d& d) {
    return std::ranges::none_of(X,
                                [&](const Eigen::Vector3d& one) { return one.dot(d) > cosine * one.norm(); });
  });
}

double excess(const std::vector<Eigen::Vector2d>& X, const std::vector<double>& w) {
  return greatest_ratio<3>(X, w, [](const Eigen::Vector2d& e) {
    const double dilation = 1 / (2 * std::numbers::sqrt2);
    return Eigen::Vector3d{dilation, e[0] * e[0] - 0.5, e[0] * e[1]};
  });
}

double excess(const std::vector<Eigen::Vector3d>& X, const std::vector<double>& w) {
  return greatest_ratio<6>(X, w, [](const Eigen::Vector3d& e) {
    const double dilation = 1 / (3 * std::sqrt(5.0)), shear = 1 / std::numbers::sqrt2;
    return Eigen::Vector<double, 6>{(e[0] * e[0] - 1.0 / 3) * shear + dilation,
                                    (e[1] * e[1] - 1.0 / 3) * shear + dilation,
                                    (e[2] * e[2] - 1.0 / 3) * shear + dilation,
                                    e[1] * e[2],
                                    e[0] * e[2],
                                    e[0] * e[1]};
  });
}

}  // namespace taut
