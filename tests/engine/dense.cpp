#include "tests/engine/dense.hpp"

#include <Eigen/Dense>

namespace taut::test {

namespace {

template <int Dim>
PrincipalAxes<Dim> axes(const Eigen::Matrix<double, Dim, Dim>& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

PrincipalAxes<2> axes_of(const Eigen::Matrix2d& symmetric) { return axes<2>(symmetric); }
PrincipalAxes<3> axes_of(const Eigen::Matrix3d& symmetric) { return axes<3>(symmetric); }

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

Eigen::Matrix3d rotation_by_singular_values(const Eigen::Matrix3d& A) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Eigen::MatrixXd orthogonal_factor(const Eigen::MatrixXd& A) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(A).householderQ() *
         Eigen::MatrixXd::Identity(A.rows(), A.rows());
}

Eigen::VectorXd solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.fullPivLu().solve(b);
}

Eigen::VectorXd solution_if_any(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double threshold) {
  Eigen::FullPivLU<Eigen::MatrixXd> lu(A);
  lu.setThreshold(threshold);
  if (!lu.isInvertible()) return {};
  return lu.solve(b);
}

}  // namespace taut::test
