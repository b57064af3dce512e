#pragma once

#include <Eigen/Core>

namespace taut {

/// A⁺ B, whose columns x are those of least |x| among those of least |A x − b|, and the rank of A; for small
/// dense systems. Compiled once: the decomposition takes a compiler longer than the files that ask for it.
struct LeastSquares {
  Eigen::MatrixXd x;
  Eigen::Index rank;
};
LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// For one fit a particle, on the stack: as many as there are monomials of the fourth degree in 3D.
using Gram = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 15, 15>;

/// G⁻¹ B of G = Aᵀ A, much faster than by A itself; empty where that could cost half of the digits, or A has not
/// its full rank.
Gram solved_by_gram(const Gram& G, const Gram& B);

}  // namespace taut
