#include "engine/core/least_squares.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

namespace taut {

LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(A);
  return {decomposition.solve(B), decomposition.rank()};
}

Gram solved_by_gram(const Gram& G, const Gram& B) {
  constexpr double least_pivot = 1e-7;
  const Eigen::LDLT<Gram> decomposition(G);
  const auto pivots = decomposition.vectorD();
  if (!(pivots.minCoeff() > least_pivot * pivots.maxCoeff())) return {};
  return decomposition.solve(B);
}

}  // namespace taut
