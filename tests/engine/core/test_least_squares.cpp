#include <doctest/doctest.h>

#include "engine/core/least_squares.hpp"

namespace of_this_file {

using namespace taut;

TEST_SUITE("unit") {
  TEST_CASE(
      "least squares: solved_by_gram gives the solution of least_squares, or is empty if A is nearly singular") {
    Eigen::MatrixXd A(6, 3);
    A << 1, 0, 0, 1, 1, 0, 1, 0, 1, 1, -1, 0.5, 1, 0.3, -1, 1, 2, 2;
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(6, -1, 3);
    const auto by_gram = [&] { return solved_by_gram(Gram(A.transpose() * A), Gram(A.transpose() * b)); };
    const LeastSquares whole = least_squares(A, b);
    CHECK(whole.rank == 3);
    REQUIRE(by_gram().rows() == 3);
    CHECK((by_gram() - Gram(whole.x)).cwiseAbs().maxCoeff() < 1e-13);
    A.col(2) = 2 * A.col(1);
    CHECK(least_squares(A, b).rank == 2);
    CHECK(by_gram().size() == 0);
    A(5, 2) += 1e-5;  // the Gram matrix would lose ten digits
    CHECK(least_squares(A, b).rank == 3);
    CHECK(by_gram().size() == 0);
  }
}

}  // namespace of_this_file
