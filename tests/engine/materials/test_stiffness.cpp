
#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "engine/materials/laws.hpp"
#include "tests/engine/dense.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

template <int Dim>
using Square = Eigen::Matrix<double, Dim, Dim>;
template <int Dim>
using Column = Eigen::Vector<double, Dim>;

class Dice {
 public:
  double between(double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 32>(random_);
  }
  template <int Dim>
  Column<Dim> direction() {
    Column<Dim> n;
    do
      for (int k = 0; k < Dim; ++k) n[k] = between(-1, 1);
    while (n.norm() > 1 || n.norm() < 0.1);
    return n.normalized();
  }
  template <int Dim>
  Square<Dim> turn() {
    Square<Dim> Q;
    for (int k = 0; k < Dim; ++k) Q.col(k) = direction<Dim>();
    Q = orthogonal_factor(Q);
    if (Q.determinant() < 0) Q.col(0) *= -1;
    return Q;
  }
  template <int Dim>
  Mat<double, Dim> strain() {
    Column<Dim> stretches;
    for (int k = 0; k < Dim; ++k) stretches[k] = std::exp(between(std::log(0.3), std::log(3)));
    const Square<Dim> F = turn<Dim>() * stretches.asDiagonal() * turn<Dim>();
    Mat<double, Dim> result;
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) result(a, b) = F(a, b);
    return result;
  }

 private:
  std::mt19937 random_{1};
};

/// ∂P/∂F, row by row.
template <int Dim>
class Tangent {
 public:
  template <class L>
  Tangent(const L& law, const Mat<double, Dim>& F) {
    constexpr double step = 1e-6;
    for (int b = 0; b < Dim; ++b) {
      for (int k = 0; k < Dim; ++k) {
        Mat<double, Dim> up = F, down = F;
        up(b, k) += step, down(b, k) -= step;
        const Mat<double, Dim> above = law.piola(up, determinant(up)),
                               below = law.piola(down, determinant(down));
        for (int a = 0; a < Dim; ++a)
          for (int c = 0; c < Dim; ++c)
            A_(a * Dim + c, b * Dim + k) = (above(a, c) - below(a, c)) / (2 * step);
      }
    }
  }
  /// ρ0 c² of waves along n, from the symmetric part of the acoustic tensor.
  Column<Dim> stiffnesses(const Column<Dim>& n) const {
    Square<Dim> Q = Square<Dim>::Zero();
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b)
        for (int c = 0; c < Dim; ++c)
          for (int k = 0; k < Dim; ++k) Q(a, b) += A_(a * Dim + c, b * Dim + k) * n[c] * n[k];
    return eigenvalues(0.5 * (Q + Q.transpose()));
  }
  double greatest(Dice& dice) const {
    constexpr int first = 60, second = 120;
    double best = 0, reach = 0.3;
    Column<Dim> where = Column<Dim>::Unit(0);
    for (int k = 0; k < first + second; ++k) {
      const Column<Dim> other = dice.direction<Dim>();
      const Column<Dim> n = k < first ? other : Column<Dim>((where + reach * other).normalized());
      const double now = stiffnesses(n)[Dim - 1];
      if (now > best) best = now, where = n;
      if (k >= first) reach *= 0.95;
    }
    return best;
  }

 private:
  Eigen::Matrix<double, Dim * Dim, Dim * Dim> A_;
};

struct Ratio {
  double least = 1e300, mean = 0;
};
template <int Dim, class L>
Ratio ratio_of(const L& law) {
  constexpr int strains = 200;
  Dice dice;
  Ratio ratio;
  for (int k = 0; k < strains; ++k) {
    const Mat<double, Dim> F = dice.strain<Dim>();
    const double real = Tangent<Dim>(law, F).greatest(dice);
    const double now = real > 0 ? law.stiffness_bound(F, determinant(F)) / real : 1;
    ratio.least = std::min(ratio.least, now);
    ratio.mean += now / strains;
  }
  return ratio;
}

template <class L>
void check_bound(const L& law, double most = 1.001) {
  for (const Ratio& ratio : {ratio_of<2>(law), ratio_of<3>(law)}) {
    CHECK(ratio.least > 1 - 1e-6);
    CHECK(ratio.mean < most);
  }
}

Mat<double, 3> diagonal(double x, double y, double z) { return {{{x, 0, 0}, {0, y, 0}, {0, 0, z}}}; }

}  // namespace

TEST_SUITE("term") {
  TEST_CASE("stiffness: no wave is faster than the bound, and the fastest waves nearly reach it on average") {
    for (const double K : {1.0, 9.67, 100.0}) {  // relative to G
      CAPTURE(K);
      check_bound(LawOf<Law::neo_hookean>{{K, 1}});
      for (const double share : {0.0, 0.4, 1.0}) check_bound(LawOf<Law::mooney_rivlin>{{K, 1, share}});
      check_bound(LawOf<Law::st_venant_kirchhoff>{{K, 1}});
      check_bound(LawOf<Law::linear_elastic>{{K, 1}});
      check_bound(LawOf<Law::rotated_piola>{{K, 1}}, 1.1);
    }
  }

  TEST_CASE("stiffness: at rest, waves have the stiffnesses K + 4G/3 and G") {
    constexpr double K = 9.67;
    const auto check = [&](const auto& law) {
      const Mat<double, 3> rest = diagonal(1, 1, 1);
      Dice dice;
      const auto Q = Tangent<3>(law, rest).stiffnesses(dice.direction<3>());
      CHECK(Q[0] == relative(1, 1e-8));
      CHECK(Q[1] == relative(1, 1e-8));
      CHECK(Q[2] == relative(K + 4.0 / 3, 1e-8));
      CHECK(law.stiffness_bound(rest, 1.0) == relative(K + 4.0 / 3, 1e-12));
    };
    check(LawOf<Law::neo_hookean>{{K, 1}});
    for (const double share : {0.0, 0.4, 1.0}) check(LawOf<Law::mooney_rivlin>{{K, 1, share}});
    check(LawOf<Law::st_venant_kirchhoff>{{K, 1}});
    check(LawOf<Law::linear_elastic>{{K, 1}});
    check(LawOf<Law::rotated_piola>{{K, 1}});
  }

  TEST_CASE("stiffness: wave speeds of the polyconvex laws diverge as a body is compressed to a plane") {
    const auto speed = [](const auto& law, const Mat<double, 3>& F) {  // relative to rest
      return std::sqrt(law.stiffness_bound(F, determinant(F)) / law.stiffness_bound(diagonal(1, 1, 1), 1.0));
    };
    const LawOf<Law::neo_hookean> neo{{9.67, 1}};
    CHECK(speed(neo, diagonal(0.46, 1, 2.17)) == relative(2.35, 0.01));
    double before = 1, before_all = 1;
    for (const double pressed : {0.5, 0.25, 0.125, 0.0625}) {
      const Mat<double, 3> F = diagonal(pressed, 1 / std::sqrt(pressed), 1 / std::sqrt(pressed));
      const double now = speed(neo, F), now_all = speed(LawOf<Law::mooney_rivlin>{{9.67, 1, 1}}, F);
      CHECK(now > 1.9 * before);
      CHECK(now_all > 2 * before_all);
      before = now, before_all = now_all;
    }
    CHECK_FALSE(neo.stiffness_bound(diagonal(std::nan(""), 1, 1), 1.0) < 1e300);
    CHECK_FALSE(neo.stiffness_bound(diagonal(0, 1, 1), 0.0) < 1e300);
  }
}

}  // namespace of_this_file
