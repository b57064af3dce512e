#pragma once

#include <Eigen/Core>

/// What tests ask of Eigen that takes longer to compile than they do.
namespace taut::test {

/// Of a symmetric matrix: rising, and their vectors of length 1 as columns.
template <int Dim>
struct PrincipalAxes {
  Eigen::Matrix<double, Dim, 1> values;
  Eigen::Matrix<double, Dim, Dim> vectors;
};
PrincipalAxes<2> axes_of(const Eigen::Matrix2d& symmetric);
PrincipalAxes<3> axes_of(const Eigen::Matrix3d& symmetric);
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);
/// λ of K x = λ M x, rising; both are symmetric, M is positive.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);

/// U Vᵀ of A = U Σ Vᵀ.
Eigen::Matrix3d rotation_by_singular_values(const Eigen::Matrix3d& A);
/// Q of A = Q R.
Eigen::MatrixXd orthogonal_factor(const Eigen::MatrixXd& A);

/// x of A x = b by full pivoting.
Eigen::VectorXd solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
/// Empty where pivots are less than `threshold` of the greatest.
Eigen::VectorXd solution_if_any(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double threshold);

}  // namespace taut::test
