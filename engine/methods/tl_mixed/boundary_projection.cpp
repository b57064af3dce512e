#include "engine/methods/tl_mixed/boundary_projection.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include "engine/core/least_squares.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Eigen::Vector3d vector(const Point& p) { return {p[0], p[1], p[2]}; }

/// Column m is e_m × z.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& z) {
  Eigen::Matrix3d m;
  m << 0, z[2], -z[1], -z[2], 0, z[0], z[1], -z[0], 0;
  return m;
}

void refer_to_centroid(std::vector<Point>& Z, const std::vector<double>& m) {
  Point sum{};
  double mass = 0;
  for (std::size_t a = 0; a < Z.size(); ++a) {
    mass += m[a];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += m[a] * Z[a][k];
  }
  for (Point& z : Z)
    for (std::size_t k = 0; k < 3; ++k) z[k] -= sum[k] / mass;
}

}  // namespace

/// Conditions for one velocity component (THEORY.md).
struct BoundaryProjection::Factor {
  std::vector<int> points;
  Sparse w;  // w_a(X_B), a column per point
  std::unique_ptr<Eigen::SimplicialLDLT<Sparse>> K;
};

BoundaryProjection::~BoundaryProjection() = default;
BoundaryProjection::BoundaryProjection(BoundaryProjection&&) noexcept = default;

BoundaryProjection::BoundaryProjection(std::vector<BoundaryPoint> points, std::vector<double> m)
    : points_(std::move(points)), m_(std::move(m)) {
  const Eigen::Map<const Eigen::VectorXd> mass(m_.data(), static_cast<Eigen::Index>(m_.size()));
  for (unsigned k = 0; k < 3; ++k) {
    Factor factor;
    std::vector<Eigen::Triplet<double>> entries;
    for (int B = 0; B < static_cast<int>(points_.size()); ++B) {
      if ((points_[B].axes >> k & 1) == 0) continue;
      for (const auto& [a, w] : points_[B].w)
        entries.emplace_back(a, static_cast<int>(factor.points.size()), w);
      factor.points.push_back(B);
    }
    factor.w.resize(mass.size(), static_cast<Eigen::Index>(factor.points.size()));
    factor.w.setFromTriplets(entries.begin(), entries.end());
    const Sparse K = factor.w.transpose() * mass.cwiseInverse().asDiagonal() * factor.w;
    factor.K = std::make_unique<Eigen::SimplicialLDLT<Sparse>>(K);
    if (factor.K->info() != Eigen::Success || !(factor.K->vectorD().array() > 0).all())
      throw SceneError(
          "method.boundary_projection",
          "the boundary conditions of some prescribed particles are linearly dependent (too few neighbours): "
          "set 'method.boundary_projection' to 0, or a greater 'method.h'");
    factors_.push_back(std::move(factor));
  }
}

Point BoundaryProjection::interpolated(const BoundaryPoint& point, const std::vector<Point>& f) const {
  Point sum{};
  for (const auto& [a, w] : point.w)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += w * f[a][k];
  return sum;
}

/// r_C contains r and C of THEORY.md, S becomes A − Cᵀ K⁻¹ C.
void BoundaryProjection::operator()(std::vector<Point>& v, std::vector<Point> Z) const {
  refer_to_centroid(Z, m_);  // (iii) holds about any origin
  Eigen::Matrix<double, 6, 6> S = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t a = 0; a < v.size(); ++a) {
    const Eigen::Matrix3d turn = cross_matrix(vector(Z[a]));
    S.topLeftCorner<3, 3>().diagonal().array() += m_[a];
    S.topRightCorner<3, 3>() += m_[a] * turn;
    S.bottomRightCorner<3, 3>() += m_[a] * turn.transpose() * turn;
  }
  S.bottomLeftCorner<3, 3>() = S.topRightCorner<3, 3>().transpose();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  std::array<Eigen::MatrixXd, 3> solved;  // K⁻¹ of r and C
  for (int k = 0; k < 3; ++k) {
    const auto& points = factors_[k].points;
    if (points.empty()) continue;
    Eigen::MatrixXd r_C = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(points.size()), 7);
    for (int row = 0; row < r_C.rows(); ++row) {
      const BoundaryPoint& point = points_[points[row]];
      r_C(row, 0) = point.velocity[k] - interpolated(point, v)[k];
      double one = 0;
      for (const auto& [a, w] : point.w) one += w;
      r_C(row, 1 + k) = one;
      r_C.row(row).tail<3>() = cross_matrix(vector(interpolated(point, Z))).row(k);
    }
    solved[k] = factors_[k].K->solve(r_C);
    const auto C = r_C.rightCols<6>();
    S -= C.transpose() * solved[k].rightCols<6>();
    right -= C.transpose() * solved[k].col(0);
  }
  // minimum norm, since S is singular if all particles are prescribed
  const Eigen::Matrix<double, 6, 1> delta = least_squares(S, right).x;
  for (std::size_t a = 0; a < v.size(); ++a) {
    const Eigen::Vector3d rigid = delta.head<3>() + cross_matrix(vector(Z[a])) * delta.tail<3>();
    for (std::size_t k = 0; k < 3; ++k) v[a][k] += rigid[static_cast<Eigen::Index>(k)];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (factors_[k].points.empty()) continue;
    const Eigen::VectorXd change = factors_[k].w * (solved[k].col(0) - solved[k].rightCols<6>() * delta);
    for (std::size_t a = 0; a < v.size(); ++a) v[a][k] += change[static_cast<Eigen::Index>(a)] / m_[a];
  }
}

}  // namespace taut
