
#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "engine/methods/bonded/layout/layout_stiffness.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;

namespace {

using Field = std::vector<Vec<double, 2>>;

/// Greatest eigenvalue of unit masses and springs between two walls. Along y each particle has its own spring.
double of_chain(const std::vector<double>& springs, int threads, int& products) {
  products = 0;
  const int n = static_cast<int>(springs.size());
  return greatest_eigenvalue<2>(n, threads, [&](const Field& u, Field& out) {
    ++products;
    for (int i = 0; i < n; ++i) {
      const double before = i > 0 ? u[i - 1][0] : 0, after = i + 1 < n ? u[i + 1][0] : 0;
      out[i] = {2 * u[i][0] - before - after, springs[i] * u[i][1]};
    }
  });
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("layout stiffness: the greatest eigenvalue of a tridiagonal matrix is exact") {
    CHECK(greatest_eigenvalue({3}, {}) == 3);
    CHECK(greatest_eigenvalue({-1, -2, -5}, {0, 0}) == test::relative(-1, 1e-12));
    for (const int n : {2, 5, 30}) {
      const double exact = 2 + 2 * std::cos(std::numbers::pi / (n + 1));
      const std::vector<double> diagonal(n, 2.0), beside(n - 1, -1.0);
      CHECK(greatest_eigenvalue(diagonal, beside) == test::relative(exact, 1e-12));
    }
    CHECK(std::isnan(greatest_eigenvalue({1, std::nan("")}, {0.5})));
  }

  TEST_CASE(
      "layout stiffness: a chain converges to 1 % in at most 20 products, and an isolated eigenvalue to 0.01 %") {
    int products = 0;
    std::vector<double> springs(3000, 1.0);
    const double chain = of_chain(springs, 1, products);
    CHECK(chain <= 4);
    CHECK(chain > 0.99 * 4);
    CHECK(products <= 20);
    springs[1234] = 9;
    CHECK(of_chain(springs, 1, products) == test::relative(9, 1e-4));
  }

  TEST_CASE("layout stiffness: the result has the same bits on 1, 2, 3 and 8 threads") {
    constexpr int n = 50000;
    int products = 0;
    const std::vector<double> springs(n, 2.0);
    Field field(n);
    for (int i = 0; i < n; ++i) field[i] = {scattered(2 * i), scattered(2 * i + 1)};
    const double alone = of_chain(springs, 1, products), square = dot(field, field, 1);
    CHECK(square == test::relative(2 * n / 3.0, 0.02));
    for (const int threads : {2, 3, 8}) {
      CHECK(dot(field, field, threads) == square);
      CHECK(of_chain(springs, threads, products) == alone);
    }
  }

  TEST_CASE(
      "layout stiffness: two masses on a preloaded spring give k (1/m + 1/M), and two clamped masses 0") {
    const double k = 3, m = 0.5, M = 2, small = 1e-3;
    const auto forces = [&](const Field& u, Field& out) {
      for (const Vec<double, 2>& one : u) CHECK(dot(one, one) <= 1.001 * small * small);
      const double pull = 7 + k * (u[1][0] - u[0][0]);
      out = {{pull, 0}, {-pull, 0}, {1, 1}};
    };
    CHECK(highest_frequency_squared<2>({1 / m, 1 / M, 0}, small, 1, forces) ==
          test::relative(k * (1 / m + 1 / M), 1e-9));
    CHECK(highest_frequency_squared<2>({1 / m, 0, 0}, small, 1, forces) == test::relative(k / m, 1e-9));
    CHECK(highest_frequency_squared<2>({0, 0, 0}, small, 1, forces) == 0);
  }
}

}  // namespace of_this_file
