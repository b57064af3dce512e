#pragma once

#include <Eigen/Core>

namespace taut::test {

/// Ascending eigenvalues, and eigenvectors as columns.
template <int Dim>
struct PrincipalAxes {
  Eigen::Matrix<double, Dim, 1> values;
  Eigen::Matrix<double, Dim, Dim> vectors;
};
PrincipalAxes<2> axes_of(const Eigen::Matrix2d& symmetric);
PrincipalAxes<3> axes_of(const Eigen::Matrix3d& symmetric);
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);
/// λ of K x = λ M x, ascending.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);

/// U Vᵀ of A = U Σ Vᵀ.
Eigen::Matrix3d rotation_by_singular_values(const Eigen::Matrix3d& A);
/// Q of A = Q R.
Eigen::MatrixXd orthogonal_factor(const Eigen::MatrixXd& A);

Eigen::VectorXd solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
/// x of A x = b, empty if a pivot is below `threshold` times the greatest pivot.
Eigen::VectorXd solution_if_any(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double threshold);

}  // namespace taut::test
