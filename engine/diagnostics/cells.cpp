#include "engine/diagnostics/cells.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "engine/neighbors/neighbors.hpp"

namespace taut {
namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

constexpr double reach = 1.6;      // of neighbours, spacings
constexpr double adjacent = 1.35;  // of those that share a side
constexpr double torn = 1.5;       // stretch beyond which a neighbour covers no more
constexpr double straight = 0.8;   // cosine of the angle within which a neighbour is in the way of a side

Vector vector(const Point& a) { return {a[0], a[1], a[2]}; }
Point point(const Vector& a) { return {a[0], a[1], a[2]}; }

}  // namespace

Cells::Cells(int dim, std::span<const double> x0, std::span<const double> diameter, std::span<const int> body)
    : dim_(static_cast<std::size_t>(dim)), x0_(x0.begin(), x0.end()), cells_(diameter.size()) {
  find_neighbors(body, diameter);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    find_axes(i);
    find_ends(i, diameter[i]);
    if (dim_ == 3 && cells_[i].inside) continue;
    find_inverse(i);
  }
  if (dim_ == 3) forget_distant();
}

Point Cells::initial(std::size_t i, std::size_t j) const {
  Point way{};
  for (std::size_t k = 0; k < dim_; ++k) way[k] = x0_[dim_ * j + k] - x0_[dim_ * i + k];
  return way;
}

std::span<const std::size_t> Cells::neighbors(std::size_t i) const {
  return std::span(neighbor_).subspan(first_[i], first_[i + 1] - first_[i]);
}

void Cells::find_neighbors(std::span<const int> body, std::span<const double> diameter) {
  const std::size_t n = cells_.size();
  first_.assign(n + 1, 0);
  if (n == 0) return;
  const double widest = reach * std::ranges::max(diameter);
  std::vector<Vec<double, 3>> places;
  for (std::size_t i = 0; i < n; ++i)
    places.push_back({{x0_[dim_ * i], x0_[dim_ * i + 1], dim_ == 3 ? x0_[dim_ * i + 2] : 0.0}});
  CellGrid<3> grid;
  const std::vector<int> order = grid.sort(places, widest);
  for (std::size_t i = 0; i < n; ++i) {
    const auto begin = static_cast<std::ptrdiff_t>(neighbor_.size());
    double nearest = 1e300;
    grid.for_each_row(places[i], [&](int from, int to) {
      for (int k = from; k < to; ++k) {
        const auto j = static_cast<std::size_t>(order[static_cast<std::size_t>(k)]);
        const double distance = vector(initial(i, j)).norm();
        if (j == i || body[j] != body[i] || distance > widest) continue;
        neighbor_.push_back(j);
        nearest = std::min(nearest, distance);
      }
    });
    const auto far = [&](std::size_t j) { return vector(initial(i, j)).norm() > reach * nearest; };
    neighbor_.erase(std::remove_if(neighbor_.begin() + begin, neighbor_.end(), far), neighbor_.end());
    cells_[i].spacing = nearest;
    first_[i + 1] = neighbor_.size();
  }
}

/// The way to the nearest neighbour, then to the one most across, and what is at right angles to both.
void Cells::find_axes(std::size_t i) {
  std::array<Vector, 3> axes{Vector::UnitX(), Vector::UnitY(), Vector::UnitZ()};
  const auto all = neighbors(i);
  const auto way = [&](std::size_t j) { return vector(initial(i, j)); };
  if (!all.empty()) {
    axes[0] =
        way(*std::ranges::min_element(all, {}, [&](std::size_t j) { return way(j).norm(); })).normalized();
    Vector across = Vector::Zero();
    double best = 1;
    for (const std::size_t j : all) {
      const Vector X = way(j);
      const double along = std::abs(X.normalized().dot(axes[0]));
      if (X.norm() < adjacent * cells_[i].spacing && along < best - 1e-9) best = along, across = X;
    }
    if (dim_ == 2)
      axes[1] = {-axes[0][1], axes[0][0], 0};
    else if (best < straight)
      axes[1] = (across - across.dot(axes[0]) * axes[0]).normalized();
    else
      axes[1] = axes[0].unitOrthogonal();
    axes[2] = axes[0].cross(axes[1]);
  }
  for (std::size_t k = 0; k < 3; ++k) cells_[i].sides[k].axis = point(axes[k]);
}

void Cells::find_ends(std::size_t i, double diameter) {
  Cell& cell = cells_[i];
  std::array<std::array<bool, 2>, 3> covered{};
  for (const std::size_t j : neighbors(i)) {
    const Vector X = vector(initial(i, j));
    if (X.norm() > adjacent * cell.spacing) continue;
    for (std::size_t k = 0; k < dim_; ++k) {
      const double along = X.normalized().dot(vector(cell.sides[k].axis));
      if (std::abs(along) > straight) covered[k][along > 0] = true;
    }
  }
  // each side without a neighbour halves the cell of a particle that stands on the boundary
  double share = 1;
  for (std::size_t k = 0; k < dim_; ++k)
    if (covered[k][0] != covered[k][1]) share *= 0.5;
  const double volume = std::pow(diameter / cell.spacing, static_cast<double>(dim_));
  const bool on_boundary = share < 1 && std::abs(volume - share) < 0.25 * share;
  const double half = 0.5 * (on_boundary ? cell.spacing : diameter);
  cell.inside = true;
  for (std::size_t k = 0; k < dim_; ++k) {
    const auto end = [&](bool there) {
      return on_boundary && !there && covered[k][0] != covered[k][1] ? 0 : half;
    };
    cell.sides[k].low = -end(covered[k][0]);
    cell.sides[k].high = end(covered[k][1]);
    cell.inside = cell.inside && covered[k][0] && covered[k][1];
  }
}

void Cells::find_inverse(std::size_t i) {
  Matrix moment = Matrix::Zero();
  for (const std::size_t j : neighbors(i)) {
    const Vector X = vector(initial(i, j));
    moment += X * X.transpose();
  }
  const double trace = moment.trace();
  // across a body that is one particle thick nothing is known: it keeps its direction
  constexpr double little = 1e-9;
  moment.diagonal().array() += trace > 0 ? little * trace : 1;
  if (dim_ == 2) moment(2, 2) = 1;
  Eigen::Map<Matrix>(cells_[i].inverse.data()) = moment.inverse();
}

/// Of those around a cell inside the adjacent ones are enough: they say whether it stays hidden, and what it is
/// like when it does not.
void Cells::forget_distant() {
  std::vector<std::size_t> first{0}, kept;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const auto wanted = [&](std::size_t j) {
      return !cells_[i].inside || vector(initial(i, j)).norm() < adjacent * cells_[i].spacing;
    };
    std::ranges::copy_if(neighbors(i), std::back_inserter(kept), wanted);
    first.push_back(kept.size());
  }
  first_ = std::move(first), neighbor_ = std::move(kept);
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (cells_[i].inside) find_inverse(i);
}

/// Now less at the start, of the way from i to j.
Point Cells::change(std::size_t i, std::size_t j, std::span<const double> x) const {
  Point way = initial(j, i);
  for (std::size_t k = 0; k < dim_; ++k) way[k] += x[dim_ * j + k] - x[dim_ * i + k];
  return way;
}

bool Cells::is_hidden(std::size_t i, std::span<const double> x) const {
  if (dim_ == 2 || !cells_[i].inside) return false;
  return std::ranges::all_of(neighbors(i), [&](std::size_t j) {
    const Vector X = vector(initial(i, j));
    return (X + vector(change(i, j, x))).squaredNorm() < torn * torn * X.squaredNorm();
  });
}

CellShapes Cells::at(std::span<const double> x) const {
  CellShapes shapes;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (is_hidden(i, x)) continue;
    Matrix sum = Matrix::Zero();
    for (const std::size_t j : neighbors(i))
      sum += vector(change(i, j, x)) * vector(initial(i, j)).transpose();
    const Matrix F = Matrix::Identity() + sum * Eigen::Map<const Matrix>(cells_[i].inverse.data());
    shapes.particle.push_back(i);
    Vector centre = Vector::Zero();
    for (std::size_t k = 0; k < dim_; ++k) {
      const auto& [axis, low, high] = cells_[i].sides[k];
      const Vector way = F * vector(axis);
      centre += 0.5 * (low + high) * way;
      for (std::size_t c = 0; c < dim_; ++c)
        shapes.edge.push_back((high - low) * way[static_cast<Eigen::Index>(c)]);
    }
    for (std::size_t c = 0; c < dim_; ++c)
      shapes.centre.push_back(x[dim_ * i + c] + centre[static_cast<Eigen::Index>(c)]);
  }
  return shapes;
}

}  // namespace taut
