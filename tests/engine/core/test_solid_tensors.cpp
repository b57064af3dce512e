
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <doctest/doctest.h>

#include "engine/core/principal_axes.hpp"
#include "engine/core/tensor.hpp"
#include "engine/materials/rotated_piola.hpp"
#include "engine/terms/artificial_stress.hpp"
#include "tests/engine/dense.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

using Matrix = Eigen::Matrix3d;

class Random {
 public:
  double number() { return 2 * std::generate_canonical<double, 53>(random_) - 1; }
  Matrix matrix() {
    return Matrix::NullaryExpr([this](Eigen::Index, Eigen::Index) { return number(); });
  }
  Matrix rotation() {
    const Eigen::Vector4d q(number(), number(), number(), number());
    return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
  }
  Matrix with_principal(double a, double b, double c) {
    const Matrix R = rotation();
    return R * Eigen::Vector3d(a, b, c).asDiagonal() * R.transpose();
  }

 private:
  std::mt19937 random_{7};
};

Mat<double, 3> mat(const Matrix& A) {
  Mat<double, 3> out;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) out(a, b) = A(a, b);
  return out;
}
Sym<double, 3> sym(const Matrix& A) { return symmetric_part(mat(A)); }
Matrix eigen(const Mat<double, 3>& A) {
  return Matrix::NullaryExpr(
      [&](Eigen::Index a, Eigen::Index b) { return A(static_cast<int>(a), static_cast<int>(b)); });
}
Matrix eigen(const Sym<double, 3>& A) { return eigen(full(A)); }
double greatest(const Matrix& A) { return A.cwiseAbs().maxCoeff(); }

std::vector<Matrix> symmetric_matrices() {
  Random random;
  std::vector<Matrix> all;
  for (int k = 0; k < 200; ++k) {
    const Matrix A = random.matrix();
    all.push_back(1e6 * (A + A.transpose()));
  }
  for (int k = 0; k < 20; ++k) {
    all.push_back(random.with_principal(2, 2, -1));
    all.push_back(random.with_principal(2, 2 + 1e-9, -1));
    all.push_back(random.with_principal(3, 3, 3));
    all.push_back(random.with_principal(-1e-12, 1e6, 0));
    all.push_back(random.with_principal(0, 0, -4));
  }
  all.push_back(Eigen::Vector3d(3, -1, 2).asDiagonal());
  all.push_back(Eigen::Vector3d(5, 5, 5).asDiagonal());
  all.push_back(Matrix::Zero());
  Matrix in_plane = Matrix::Zero();
  in_plane(0, 2) = in_plane(2, 0) = 1;
  all.push_back(in_plane);
  return all;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("principal axes: values equal Eigen's, and axes are orthonormal, also for equal values") {
    for (const Matrix& A : symmetric_matrices()) {
      CAPTURE(A(0, 0));
      CAPTURE(A(0, 1));
      const double scale = greatest(A);
      const Principal principal = principal_axes(sym(A));
      Matrix Q;
      Eigen::Vector3d values;
      for (int k = 0; k < 3; ++k) {
        values[k] = principal.value[k];
        for (int a = 0; a < 3; ++a) Q(a, k) = principal.axis[k][a];
      }
      CHECK(greatest(Q * values.asDiagonal() * Q.transpose() - A) <= 1e-14 * scale);
      CHECK(greatest(Q.transpose() * Q - Matrix::Identity()) < 1e-14);
      std::ranges::sort(values);
      const Eigen::Vector3d expected = axes_of(A).values;
      CHECK((values - expected).cwiseAbs().maxCoeff() <= 1e-14 * scale);
    }
  }

  TEST_CASE("artificial stress: in 3D the positive part contains the positive principal stresses") {
    int mixed = 0;
    for (const Matrix& A : symmetric_matrices()) {
      const auto& [values, vectors] = axes_of(A);
      mixed += values[0] < -1 && values[2] > 1;
      const Matrix expected = vectors * values.cwiseMax(0).asDiagonal() * vectors.transpose();
      CHECK(greatest(eigen(positive_part(sym(A))) - expected) <= 1e-14 * greatest(A));
    }
    CHECK(mixed > 100);
    const Matrix pressed = -Matrix::Identity();
    CHECK(greatest(eigen(positive_part(sym(pressed)))) == 0);
  }

  TEST_CASE("tensors: in 3D determinant, cofactor and inverse satisfy their definitions") {
    Random random;
    for (int k = 0; k < 200; ++k) {
      const Matrix A = random.matrix();
      CHECK(std::abs(determinant(mat(A)) - A.determinant()) < 1e-14);
      CHECK(greatest(A.transpose() * eigen(cofactor(mat(A))) - A.determinant() * Matrix::Identity()) < 1e-14);
      const Matrix C = A.transpose() * A + 0.1 * Matrix::Identity();
      CHECK(greatest(eigen(inverse(sym(C))) * C - Matrix::Identity()) < 1e-12);
    }
    CHECK(greatest(eigen(inverse(sym(random.with_principal(1, 1, 0))))) == 0);
    CHECK(greatest(eigen(inverse(Sym<double, 3>{}))) == 0);
  }

  TEST_CASE("rotation: in 3D the nearest rotation is the polar one, also beyond 90 degrees") {
    Random random;
    int far = 0;
    for (int k = 0; k < 300; ++k) {
      const auto stretch = [&] { return 1 + 0.6 * random.number(); };
      const Matrix U = random.with_principal(stretch(), stretch(), stretch());
      const Matrix R = random.rotation();
      const Matrix F = R * U;
      REQUIRE(F.determinant() > 0);
      far += R.trace() < 1;  // 1 + 2 cos of the angle
      CHECK(greatest(rotation_by_singular_values(F) - R) < 1e-13);
      CHECK(greatest(eigen(nearest_rotation(mat(F))) - R) < 1e-13);
    }
    CHECK(far > 100);
    for (const double angle : {0.0, 0.3, 1.7, 3.0, 3.14}) {
      const Matrix R = Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, -2) / 3).toRotationMatrix();
      CHECK(greatest(eigen(nearest_rotation(mat(R))) - R) < 1e-13);
    }
  }
}

}  // namespace of_this_file
