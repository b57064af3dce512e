#include "engine/methods/tl_mixed/boundary_projection.hpp"

#include <Eigen/SparseCholesky>

#include "engine/error.hpp"

namespace taut {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

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

std::vector<Point> BoundaryProjection::operator()(std::vector<Point>& v) const {
  std::vector<Point> impulses(points_.size(), Point{});
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [points, w, K] = factors_[k];
    if (points.empty()) continue;
    Eigen::VectorXd v_k(w.rows()), r(w.cols());
    for (Eigen::Index a = 0; a < w.rows(); ++a) v_k[a] = v[a][k];
    for (Eigen::Index B = 0; B < w.cols(); ++B) r[B] = points_[points[B]].velocity[k];
    r -= w.transpose() * v_k;
    const Eigen::VectorXd beta = K->solve(r), change = w * beta;
    for (Eigen::Index B = 0; B < w.cols(); ++B) impulses[points[B]][k] = beta[B];
    for (Eigen::Index a = 0; a < w.rows(); ++a) v[a][k] += change[a] / m_[a];
  }
  return impulses;
}

}  // namespace taut
