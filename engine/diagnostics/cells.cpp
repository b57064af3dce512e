#include "engine/diagnostics/cells.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <utility>

#include <Eigen/Geometry>

namespace taut {
namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double adjacent = 1.35;  // in Cell::spacing, greatest distance of cells that share a side
constexpr double torn = 1.5;       // stretch from which a neighbour no longer covers a cell
constexpr double straight = 0.8;   // cosine from which a direction counts as along an axis

Vector vector(const Point& a) { return {a[0], a[1], a[2]}; }
Point point(const Vector& a) { return {a[0], a[1], a[2]}; }

}  // namespace

Cells::Cells(int dim, std::span<const double> x0, std::span<const double> diameter, std::span<const int> body)
    : dim_(static_cast<std::size_t>(dim)), x0_(x0.begin(), x0.end()), cells_(diameter.size()) {
  FirstNeighbors around = first_neighbors({dim, x0, diameter, body});
  first_ = std::move(around.first), neighbor_ = std::move(around.neighbor);
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].spacing = around.spacing[i];
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    find_axes(i);
    find_ends(i, diameter[i]);
    if (dim_ == 3 && cells_[i].inside) continue;
    find_inverse(i);
  }
  if (dim_ == 3) forget_distant();
}

void Cells::take_ends(const Cells& all, std::span<const std::size_t> shown) {
  for (std::size_t k = 0; k < cells_.size(); ++k) cells_[k].sides = all.cells_[shown[k]].sides;
}

Point Cells::initial(std::size_t i, std::size_t j) const {
  Point way{};
  for (std::size_t k = 0; k < dim_; ++k) way[k] = x0_[dim_ * j + k] - x0_[dim_ * i + k];
  return way;
}

std::span<const std::size_t> Cells::neighbors(std::size_t i) const {
  return std::span(neighbor_).subspan(first_[i], first_[i + 1] - first_[i]);
}

/// In 2D the axes are the best fit to the adjacent neighbours, since the layers of a ring are staggered.
void Cells::find_axes(std::size_t i) {
  std::array<Vector, 3> axes{Vector::UnitX(), Vector::UnitY(), Vector::UnitZ()};
  Vector across = Vector::Zero();
  double least = 1e300, best = 1;
  std::complex<double> four_fold = 0;
  const auto each_adjacent = [&](const auto& visit) {
    for (const std::size_t j : neighbors(i))
      if (const Vector X = vector(initial(i, j)); X.norm() < adjacent * cells_[i].spacing) visit(X);
  };
  each_adjacent([&](const Vector& X) {
    four_fold += std::polar(1.0, 4 * std::atan2(X[1], X[0]));
    if (X.norm() < least) least = X.norm(), axes[0] = X.normalized();
  });
  each_adjacent([&](const Vector& X) {
    const double along = std::abs(X.normalized().dot(axes[0]));
    if (along < best - 1e-9) best = along, across = X;
  });
  if (dim_ == 2) {
    const double angle = std::arg(four_fold) / 4;
    axes[0] = {std::cos(angle), std::sin(angle), 0};
    axes[1] = {-std::sin(angle), std::cos(angle), 0};
  } else if (least < 1e300) {
    axes[1] = best < straight ? Vector((across - across.dot(axes[0]) * axes[0]).normalized())
                              : axes[0].unitOrthogonal();
    axes[2] = axes[0].cross(axes[1]);
  }
  for (std::size_t k = 0; k < 3; ++k) cells_[i].sides[k].axis = point(axes[k]);
}

void Cells::find_ends(std::size_t i, double diameter) {
  Cell& cell = cells_[i];
  constexpr double open = 1e300;
  std::array<std::array<double, 2>, 3> half;  // distance to each side, m
  for (auto& ends : half) ends = {open, open};
  for (const std::size_t j : neighbors(i)) {
    const Vector X = vector(initial(i, j));
    if (X.norm() > adjacent * cell.spacing) continue;
    for (std::size_t k = 0; k < dim_; ++k) {
      const double along = X.dot(vector(cell.sides[k].axis));
      double& end = half[k][along > 0];
      if (std::abs(along) > straight * X.norm()) end = std::min(end, 0.5 * std::abs(along));
    }
  }
  const auto one_open = [&](std::size_t k) { return (half[k][0] < open) != (half[k][1] < open); };
  // at most about half of the cell of a boundary particle lies in the body
  const double part = std::pow(diameter / cell.spacing, static_cast<double>(dim_));
  const bool on_boundary = part < 0.75;
  cell.inside = true;
  for (std::size_t k = 0; k < dim_; ++k) {
    const double inner = std::min(half[k][0], half[k][1]);
    const double outer = on_boundary && one_open(k) ? 0 : inner < open ? inner : 0.5 * diameter;
    cell.sides[k].low = -(half[k][0] < open ? half[k][0] : outer);
    cell.sides[k].high = half[k][1] < open ? half[k][1] : outer;
    cell.inside = cell.inside && half[k][0] < open && half[k][1] < open;
  }
}

LinearMap Cells::moment(std::size_t i) const {
  LinearMap sum{};
  for (const std::size_t j : neighbors(i)) {
    const Vector X = vector(initial(i, j));
    Eigen::Map<Matrix>(sum.data()) += X * X.transpose();
  }
  return sum;
}

void Cells::find_inverse(std::size_t i) {
  const LinearMap of_neighbors = moment(i);
  cells_[i].inverse = inverse_moment(of_neighbors, static_cast<int>(dim_));
  cells_[i].thin = is_thin(of_neighbors, static_cast<int>(dim_));
}

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
    LinearMap map;
    Eigen::Map<Matrix> F(map.data());
    F = Matrix::Identity() + sum * Eigen::Map<const Matrix>(cells_[i].inverse.data());
    if (cells_[i].thin) map = turned_across(map, moment(i), static_cast<int>(dim_));
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
