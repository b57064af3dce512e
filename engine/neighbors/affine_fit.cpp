#include "engine/neighbors/affine_fit.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "engine/neighbors/neighbors.hpp"

namespace taut {
namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double reach = 1.6;  // in spacings
constexpr double thin = 1e-6;  // of the mean moment

InitialPositions initial_positions(const Snapshot& now) { return {now.dim, now.x0, now.diameter, now.body}; }

void keep_near(const InitialPositions& start, std::size_t i, std::vector<std::size_t>& found,
               std::size_t begin, double nearest) {
  const auto far = [&](std::size_t j) { return start.distance(i, j) > reach * nearest; };
  found.erase(std::remove_if(found.begin() + static_cast<std::ptrdiff_t>(begin), found.end(), far),
              found.end());
}

LinearMap linear_map(const Matrix& matrix) {
  LinearMap map;
  Eigen::Map<Matrix>(map.data()) = matrix;
  return map;
}

LinearMap fitted(const Snapshot& now, std::size_t i, std::span<const std::size_t> neighbors) {
  const InitialPositions start = initial_positions(now);
  const auto d = static_cast<std::size_t>(now.dim);
  Matrix moment = Matrix::Zero(), sum = Matrix::Zero();
  for (const std::size_t j : neighbors) {
    const Point way = start.way(i, j);
    Vector change = Vector::Zero();
    for (std::size_t k = 0; k < d; ++k)
      change[static_cast<Eigen::Index>(k)] = now.x[d * j + k] - now.x[d * i + k] - way[k];
    const Vector X(way[0], way[1], way[2]);
    moment += X * X.transpose();
    sum += change * X.transpose();
  }
  const LinearMap all = linear_map(moment), inverse = inverse_moment(all, now.dim),
                  F = linear_map(Matrix::Identity() + sum * Eigen::Map<const Matrix>(inverse.data()));
  return is_thin(all, now.dim) ? turned_across(F, all, now.dim) : F;
}

}  // namespace

Point InitialPositions::way(std::size_t i, std::size_t j) const {
  const auto d = static_cast<std::size_t>(dim);
  Point way{};
  for (std::size_t k = 0; k < d; ++k) way[k] = x0[d * j + k] - x0[d * i + k];
  return way;
}

double InitialPositions::distance(std::size_t i, std::size_t j) const {
  const Point X = way(i, j);
  return std::sqrt(X[0] * X[0] + X[1] * X[1] + X[2] * X[2]);
}

FirstNeighbors first_neighbors(const InitialPositions& start) {
  FirstNeighbors all;
  const std::size_t n = start.diameter.size(), d = static_cast<std::size_t>(start.dim);
  all.first.assign(n + 1, 0);
  if (n == 0) return all;
  const double widest = reach * std::ranges::max(start.diameter);
  std::vector<Vec<double, 3>> places;
  for (std::size_t i = 0; i < n; ++i)
    places.push_back({{start.x0[d * i], start.x0[d * i + 1], d == 3 ? start.x0[d * i + 2] : 0.0}});
  CellGrid<3> grid;
  const std::vector<int> order = grid.sort(places, widest);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t begin = all.neighbor.size();
    double nearest = 1e300;
    grid.for_each_row(places[i], [&](int from, int to) {
      for (int k = from; k < to; ++k) {
        const auto j = static_cast<std::size_t>(order[static_cast<std::size_t>(k)]);
        const double distance = start.distance(i, j);
        if (j == i || start.body[j] != start.body[i] || distance > widest) continue;
        all.neighbor.push_back(j);
        nearest = std::min(nearest, distance);
      }
    });
    keep_near(start, i, all.neighbor, begin, nearest);
    all.spacing.push_back(nearest);
    all.first[i + 1] = all.neighbor.size();
  }
  return all;
}

LinearMap inverse_moment(const LinearMap& moment, int dim) {
  constexpr double little = 1e-9;  // for bodies one particle thick
  Matrix regular = Eigen::Map<const Matrix>(moment.data());
  const double trace = regular.trace();
  regular.diagonal().array() += trace > 0 ? little * trace : 1;
  if (dim == 2) regular(2, 2) = 1;
  return linear_map(regular.inverse());
}

bool is_thin(const LinearMap& moment, int dim) {
  const Eigen::Map<const Matrix> all(moment.data());
  const double mean = all.trace() / dim,
               det = dim == 2 ? all.topLeftCorner<2, 2>().determinant() : all.determinant();
  return mean > 0 && det < thin * std::pow(mean, dim);
}

LinearMap turned_across(const LinearMap& F, const LinearMap& moment, int dim) {
  Matrix all = Eigen::Map<const Matrix>(moment.data()), map = Eigen::Map<const Matrix>(F.data());
  if (dim == 2) all(2, 2) = all.trace();
  const Eigen::SelfAdjointEigenSolver<Matrix> axes(all);  // eigenvalues increase
  const Matrix& n = axes.eigenvectors();
  const Vector u = map * n.col(2);
  if (axes.eigenvalues()[1] < thin * all.trace()) {  // a row in 3D
    map = u * n.col(2).transpose();
    const auto turn = Eigen::Quaterniond::FromTwoVectors(n.col(2), u);
    for (const int k : {0, 1}) map += (turn * Vector(n.col(k))) * n.col(k).transpose();
  } else {
    const Vector normal = (map * n.col(1)).cross(u).normalized() * n.determinant();
    map += (normal - map * n.col(0)) * n.col(0).transpose();
  }
  return linear_map(map);
}

std::vector<LinearMap> affine_maps(const Snapshot& now) {
  const FirstNeighbors neighbors = first_neighbors(initial_positions(now));
  std::vector<LinearMap> maps;
  maps.reserve(now.size());
  for (std::size_t i = 0; i < now.size(); ++i) maps.push_back(fitted(now, i, neighbors[i]));
  return maps;
}

}  // namespace taut
