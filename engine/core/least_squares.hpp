#pragma once

#include <Eigen/Core>

namespace taut {

/// Minimum-norm solution A⁺ B and rank of A.
struct LeastSquares {
  Eigen::MatrixXd x;
  Eigen::Index rank;
};
LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Gram matrix or right-hand sides.
using Gram = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 15, 15>;

/// G⁻¹ B for G = Aᵀ A; empty if G is ill-conditioned.
Gram solved_by_gram(const Gram& G, const Gram& B);

}  // namespace taut
