#pragma once

#include <Eigen/Core>

namespace taut {

/// Minimum-norm solution A⁺ B and rank of A. Compiled in one file, since Eigen's decomposition compiles slowly.
struct LeastSquares {
  Eigen::MatrixXd x;
  Eigen::Index rank;
};
LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Gram matrix or right-hand sides; at most 15 × 15, for the 15 fourth-degree monomials in 3D.
using Gram = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 15, 15>;

/// Returns G⁻¹ B for G = Aᵀ A, faster than `least_squares` with A. The result is empty if A lacks full rank or half of
/// the digits could be lost.
Gram solved_by_gram(const Gram& G, const Gram& B);

}  // namespace taut
