#pragma once

#include <Eigen/Core>

namespace taut {

/// x of least |x| of those with the least |A x − b|; for small dense systems of any rank. Compiled once: the
/// decomposition takes a compiler longer than the files that ask for it.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace taut
