#include "engine/diagnostics/lattice_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include <Eigen/Dense>

namespace taut {
namespace {

using LatticeSite = std::array<int, 3>;  // plane numbers
using Vector = Eigen::Vector3d;
using Corners = std::array<Vector, 8>;  // bit k: upper corner along axis k

/// Plane number of each coordinate; gaps skip a number.
std::vector<int> planes(const std::vector<double>& x, double apart) {
  constexpr double widest = 1.5;
  std::vector<double> sorted = x, first;
  std::ranges::sort(sorted);
  for (const double at : sorted)
    if (first.empty() || at > first.back() + apart) first.push_back(at);
  double pitch = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < first.size(); ++k) pitch = std::min(pitch, first[k] - first[k - 1]);
  std::vector<int> number(first.size(), 0), plane;
  for (std::size_t k = 1; k < first.size(); ++k)
    number[k] = number[k - 1] + (first[k] - first[k - 1] < widest * pitch ? 1 : 2);
  for (const double at : x)
    plane.push_back(
        number[static_cast<std::size_t>(std::ranges::upper_bound(first, at) - first.begin() - 1)]);
  return plane;
}

std::map<LatticeSite, std::size_t> sites(const Snapshot& now, int body) {
  std::vector<std::size_t> particles;
  double least = 1e300;  // diameter, m
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now.body[i] != body) continue;
    particles.push_back(i);
    least = std::min(least, now.diameter[i]);
  }
  std::vector<LatticeSite> site(particles.size());
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double> along;
    for (const std::size_t i : particles) along.push_back(now.initial(i)[k]);
    const std::vector<int> plane = planes(along, 0.1 * least);
    for (std::size_t p = 0; p < particles.size(); ++p) site[p][k] = plane[p];
  }
  std::map<LatticeSite, std::size_t> at;
  for (std::size_t p = 0; p < particles.size(); ++p) at[site[p]] = particles[p];
  return at;
}

/// Integral of the Jacobian of the trilinear map; two Gauss points per axis are exact.
double volume(const Corners& corner) {
  const double offset = 0.5 / std::sqrt(3.0);
  double sum = 0;
  for (unsigned point = 0; point < 8; ++point) {
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    for (unsigned c = 0; c < 8; ++c) {
      double value[3];
      for (unsigned k = 0; k < 3; ++k) {
        const double at = 0.5 + ((point >> k & 1) ? offset : -offset);
        value[k] = (c >> k & 1) ? at : 1 - at;
      }
      const auto sign = [&](unsigned k) { return (c >> k & 1) ? 1.0 : -1.0; };
      const Vector slope{sign(0) * value[1] * value[2], value[0] * sign(1) * value[2],
                         value[0] * value[1] * sign(2)};
      gradient += corner[c] * slope.transpose();
    }
    sum += gradient.determinant() / 8;
  }
  return sum;
}

}  // namespace

double lattice_volume(const Snapshot& now, int body, std::span<const double> x) {
  const auto dim = static_cast<std::size_t>(now.dim);
  const std::map<LatticeSite, std::size_t> at = sites(now, body);
  double total = 0;
  for (const auto& [low, particle] : at) {
    Corners corner;
    bool whole = true;
    for (unsigned c = 0; c < 8 && whole; ++c) {
      LatticeSite site = low;
      for (unsigned k = 0; k < dim; ++k) site[k] += c >> k & 1;
      const auto found = at.find(site);
      whole = found != at.end();
      if (!whole) break;
      corner[c] = Vector::Zero();
      for (unsigned k = 0; k < dim; ++k) corner[c][k] = x[found->second * dim + k];
      if (dim == 2) corner[c][2] = c >> 2 & 1;
    }
    if (whole) total += volume(corner);
  }
  return total;
}

}  // namespace taut
