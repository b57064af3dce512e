#pragma once

#include <Eigen/Core>

namespace taut {

/// Minimum-norm solution A⁺ B and rank of A. Compiled once, since Eigen's decomposition compiles slowly.
struct LeastSquares {
  Eigen::MatrixXd x;
  Eigen::Index rank;
};
LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Up to the 15 fourth-degree monomials in 3D.
using Gram = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 15, 15>;

/// G⁻¹ B for G = Aᵀ A, faster than with A. Empty if A lacks full rank or half of the digits could be lost.
Gram solved_by_gram(const Gram& G, const Gram& B);

}  // namespace taut
