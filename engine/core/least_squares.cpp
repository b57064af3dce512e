#include "engine/core/least_squares.hpp"

#include <Eigen/QR>

namespace taut {

LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(A);
  return {decomposition.solve(B), decomposition.rank()};
}

}  // namespace taut
