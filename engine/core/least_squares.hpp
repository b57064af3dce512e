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

}  // namespace taut
