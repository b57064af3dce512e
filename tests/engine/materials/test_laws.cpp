// Laws of elasticity: P = ∂ψ/∂F, σ = P Fᵀ/J, no stress at rest, turned bodies.

#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/materials/laws.hpp"
#include "tests/support/relative.hpp"

using namespace taut;
using namespace taut::test;

namespace {

using M2 = Mat<double, 2>;
constexpr double K = 3.1e6, G = 1.7e6;  // Pa

const M2 strained[] = {
    {{{1.2, 0.3}, {-0.1, 0.9}}}, {{{0.7, -0.2}, {0.4, 0.8}}}, {{{1.01, 0.02}, {0.01, 0.98}}}};

M2 rotation(double angle) {
  return {{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}}};
}
M2 times(const M2& A, const M2& B) {
  M2 C{};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) C(a, b) = A(a, 0) * B(0, b) + A(a, 1) * B(1, b);
  return C;
}
double greatest(const M2& A) {
  double most = 0;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) most = std::max(most, std::abs(A(a, b)));
  return most;
}
M2 minus(const M2& A, const M2& B) { return combination(1.0, A, -1.0, B); }
M2 full(const Sym<double, 2>& s) { return {{{s(0, 0), s(0, 1)}, {s(0, 1), s(1, 1)}}}; }

/// ∂ψ/∂F by central differences.
template <class L>
M2 slope_of_energy(const L& law, const M2& F) {
  constexpr double step = 1e-5;
  M2 P;
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      M2 up = F, down = F;
      up(a, b) += step, down(a, b) -= step;
      P(a, b) = (law.energy(up, determinant(up)) - law.energy(down, determinant(down))) / (2 * step);
    }
  }
  return P;
}

template <class L>
void check_rest(const L& law) {
  const M2 one{{{1, 0}, {0, 1}}};
  CHECK(greatest(law.piola(one, 1)) < 1e-9 * K);
  CHECK(std::abs(law.energy(one, 1)) < 1e-9 * K);
  CHECK(std::abs(law.cauchy(one, 1).zz) < 1e-9 * K);
}

/// The response to a small strain is Hooke's, of plane strain.
template <class L>
void check_small_strain(const L& law) {
  constexpr double small = 1e-6;
  const M2 F{{{1 + 2 * small, 0.5 * small}, {0.7 * small, 1 - 3 * small}}};
  const double trace = -small, lambda = K - 2.0 / 3 * G;
  const auto [sigma, zz] = law.cauchy(F, determinant(F));
  CHECK(sigma(0, 0) == relative(lambda * trace + 2 * G * 2 * small, 1e-4));
  CHECK(sigma(1, 1) == relative(lambda * trace - 2 * G * 3 * small, 1e-4));
  CHECK(sigma(0, 1) == relative(2 * G * 0.6 * small, 1e-4));
  CHECK(zz == relative(lambda * trace, 1e-4));
}

template <class L>
void check_derivative(const L& law) {
  for (const M2& F : strained) {
    const M2 P = law.piola(F, determinant(F));
    CHECK(greatest(P) > 0.01 * G);
    CHECK(greatest(minus(P, slope_of_energy(law, F))) < 1e-8 * greatest(P));
  }
}

template <class L>
void check_cauchy(const L& law) {
  for (const M2& F : strained) {
    const double J = determinant(F);
    const M2 P = law.piola(F, J);
    const M2 transposed{{{F(0, 0), F(1, 0)}, {F(0, 1), F(1, 1)}}};
    const M2 sigma = combination(1 / J, times(P, transposed), 0.0, P);
    CHECK(std::abs(sigma(0, 1) - sigma(1, 0)) < 1e-12 * greatest(sigma));  // no couple
    CHECK(greatest(minus(sigma, full(law.cauchy(F, J).sigma))) < 1e-12 * greatest(sigma));
  }
}

/// Q F is given the stress Q P, the same energy and the same stress normal to the plane.
template <class L>
double lack_of_objectivity(const L& law) {
  double lack = 0;
  for (const M2& F : strained) {
    for (const double angle : {0.3, 1.9, 3.1, -2.5}) {
      const M2 Q = rotation(angle), QF = times(Q, F);
      const double J = determinant(F), scale = greatest(law.piola(F, J));
      lack = std::max(lack, greatest(minus(law.piola(QF, J), times(Q, law.piola(F, J)))) / scale);
      lack = std::max(lack, std::abs(law.energy(QF, J) - law.energy(F, J)) / scale);
      lack = std::max(lack, std::abs(law.cauchy(QF, J).zz - law.cauchy(F, J).zz) / scale);
    }
  }
  return lack;
}

}  // namespace

TEST_SUITE("term") {
  TEST_CASE("laws: no stress at rest, Hooke's law for small strains") {
    const auto check = [](const auto& law) {
      check_rest(law);
      check_small_strain(law);
    };
    check(LawOf<Law::neo_hookean>{{K, G}});
    check(LawOf<Law::st_venant_kirchhoff>{{K, G}});
    check(LawOf<Law::linear_elastic>{{K, G}});
    check(LawOf<Law::rotated_piola>{{K, G}});
  }

  TEST_CASE("laws: P is the derivative of the energy, but for the turned stress of icb") {
    check_derivative(LawOf<Law::neo_hookean>{{K, G}});
    check_derivative(LawOf<Law::st_venant_kirchhoff>{{K, G}});
    check_derivative(LawOf<Law::linear_elastic>{{K, G}});
    const LawOf<Law::rotated_piola> turned{{K, G}};
    const M2& F = strained[0];
    const M2 P = turned.piola(F, determinant(F));
    CHECK(greatest(minus(P, slope_of_energy(turned, F))) > 0.1 * greatest(P));
  }

  TEST_CASE("laws: P Fᵀ/J is the Cauchy stress, symmetric") {
    check_cauchy(LawOf<Law::neo_hookean>{{K, G}});
    check_cauchy(LawOf<Law::st_venant_kirchhoff>{{K, G}});
    check_cauchy(LawOf<Law::rotated_piola>{{K, G}});
  }

  TEST_CASE("laws: turn with the body, but for the linear one") {
    CHECK(lack_of_objectivity(LawOf<Law::neo_hookean>{{K, G}}) < 1e-12);
    CHECK(lack_of_objectivity(LawOf<Law::st_venant_kirchhoff>{{K, G}}) < 1e-12);
    CHECK(lack_of_objectivity(LawOf<Law::rotated_piola>{{K, G}}) < 1e-12);
    CHECK(lack_of_objectivity(LawOf<Law::linear_elastic>{{K, G}}) > 0.1);
  }

  TEST_CASE("laws: the neo-Hookean stress is that of the Cauchy form −K (J − 1), G J^(−5/3) dev(F Fᵀ)") {
    const LawOf<Law::neo_hookean> law{{K, G}};
    for (const M2& F : strained) {
      const double J = determinant(F), scale = G * std::pow(J, -5.0 / 3);
      const M2 transposed{{{F(0, 0), F(1, 0)}, {F(0, 1), F(1, 1)}}};
      const M2 b = times(F, transposed);
      const double mean = (b(0, 0) + b(1, 1) + 1) / 3;
      const auto [sigma, zz] = law.cauchy(F, J);
      CHECK(sigma(0, 0) == relative(K * (J - 1) + scale * (b(0, 0) - mean), 1e-12));
      CHECK(sigma(0, 1) == relative(scale * b(0, 1), 1e-12));
      CHECK(zz == relative(K * (J - 1) + scale * (1 - mean), 1e-12));
    }
  }

  TEST_CASE("laws: the rotation nearest to F, in closed form") {
    for (const double angle : {0.0, 0.4, 2.0, 3.1, -1.7}) {
      const M2 R = rotation(angle), U{{{1.4, 0.2}, {0.2, 0.6}}};
      CHECK(greatest(minus(nearest_rotation(times(R, U)), R)) < 1e-14);
    }
    const M2 reflection{{{1, 0}, {0, -1}}};  // two rotations are as near
    CHECK(greatest(minus(nearest_rotation(reflection), M2{{{1, 0}, {0, 1}}})) == 0);
    const M2 nothing{};
    CHECK(greatest(minus(nearest_rotation(nothing), M2{{{1, 0}, {0, 1}}})) == 0);
  }
}
