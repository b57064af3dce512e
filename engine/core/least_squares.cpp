#include "engine/core/least_squares.hpp"

#include <Eigen/QR>

namespace taut {

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

}  // namespace taut
