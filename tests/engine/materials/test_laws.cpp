
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/materials/chosen_laws.hpp"
#include "engine/methods/all_methods.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

using M2 = Mat<double, 2>;
using M3 = Mat<double, 3>;
constexpr double K = 3.1e6, G = 1.7e6;

template <int Dim>
std::vector<Mat<double, Dim>> strained() {
  if constexpr (Dim == 2)
    return {{{{1.2, 0.3}, {-0.1, 0.9}}}, {{{0.7, -0.2}, {0.4, 0.8}}}, {{{1.01, 0.02}, {0.01, 0.98}}}};
  else
    return {{{{1.2, 0.3, -0.2}, {-0.1, 0.9, 0.25}, {0.15, -0.05, 0.8}}},
            {{{0.7, -0.2, 0.1}, {0.4, 0.8, 0.3}, {-0.3, 0.2, 1.3}}},
            {{{1.01, 0.02, 0.01}, {0.01, 0.98, -0.01}, {0, 0.02, 1.005}}}};
}

M2 rotation(double angle) {
  return {{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}}};
}
template <int Dim>
Mat<double, Dim> identity() {
  Mat<double, Dim> I{};
  for (int k = 0; k < Dim; ++k) I(k, k) = 1;
  return I;
}
template <int Dim>
Mat<double, Dim> turn(double angle) {
  if constexpr (Dim == 2) {
    return rotation(angle);
  } else {
    const Vec<double, 3> axis{0.36, -0.48, 0.8};
    return turned_by(angle * axis, angle, identity<3>());
  }
}
template <int Dim>
Mat<double, Dim> times(const Mat<double, Dim>& A, const Mat<double, Dim>& B) {
  Mat<double, Dim> C{};
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b)
      for (int k = 0; k < Dim; ++k) C(a, b) += A(a, k) * B(k, b);
  return C;
}
template <int Dim>
Mat<double, Dim> transposed(const Mat<double, Dim>& A) {
  Mat<double, Dim> T;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) T(a, b) = A(b, a);
  return T;
}
template <int Dim>
double greatest(const Mat<double, Dim>& A) {
  double most = 0;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) most = std::max(most, std::abs(A(a, b)));
  return most;
}
template <int Dim>
Mat<double, Dim> minus(const Mat<double, Dim>& A, const Mat<double, Dim>& B) {
  return combination(1.0, A, -1.0, B);
}

template <int Dim, class Function>
Mat<double, Dim> slope(const Mat<double, Dim>& F, const Function& f) {
  constexpr double step = 1e-5;
  Mat<double, Dim> slope;
  for (int a = 0; a < Dim; ++a) {
    for (int b = 0; b < Dim; ++b) {
      Mat<double, Dim> up = F, down = F;
      up(a, b) += step, down(a, b) -= step;
      slope(a, b) = (f(up) - f(down)) / (2 * step);
    }
  }
  return slope;
}
template <int Dim, class L>
Mat<double, Dim> slope_of_energy(const L& law, const Mat<double, Dim>& F) {
  return slope(F, [&](const Mat<double, Dim>& at) { return law.energy(at, determinant(at)); });
}

template <int Dim, class L>
void check_four(const L& law, const L& other) {
  std::vector<Mat<double, Dim>> F = strained<Dim>();
  Mat<double, Dim> turned_inside_out = identity<Dim>();
  turned_inside_out(0, 0) = -0.9;
  F.insert(F.begin(), turned_inside_out);
  Mat<Pack, Dim> four;
  for (int lane = 0; lane < lanes; ++lane) set_lane(four, lane, F[lane]);
  const std::vector<L> both{law, other};
  const std::vector<int> materials{0, 1, 1, 0};
  const LawsOfFour<L> laws{both.data(), materials.data()};
  const Pack J = determinant(four);
  const Mat<Pack, Dim> P = laws(0, [&](const L& own) { return own.piola(four, J); });
  const Pack bound = laws(0, [&](const L& own) { return own.stiffness_bound(four, J); });
  for (int lane = 0; lane < lanes; ++lane) {
    const L& own = both[materials[lane]];
    const Mat<double, Dim> expected = own.piola(F[lane], determinant(F[lane]));
    CHECK(greatest(minus(lane_of(P, lane), expected)) <= 1e-14 * greatest(expected));
    CHECK(bound[lane] == relative(own.stiffness_bound(F[lane], determinant(F[lane])), 1e-14));
  }
}

template <int Dim, class L>
void check_rest(const L& law) {
  const auto one = identity<Dim>();
  CHECK(greatest(law.piola(one, 1.0)) < 1e-9 * K);
  CHECK(std::abs(law.energy(one, 1)) < 1e-9 * K);
  CHECK(std::abs(law.cauchy(one, 1).zz) < 1e-9 * K);
}

template <int Dim, class L>
void check_small_strain(const L& law) {
  constexpr double small = 1e-6;
  Mat<double, Dim> F = identity<Dim>();
  F(0, 0) += 2 * small, F(0, 1) += 0.5 * small, F(1, 0) += 0.7 * small, F(1, 1) -= 3 * small;
  const double trace = -small, lambda = K - 2.0 / 3 * G;
  const auto [sigma, zz] = law.cauchy(F, determinant(F));
  CHECK(sigma(0, 0) == relative(lambda * trace + 2 * G * 2 * small, 1e-4));
  CHECK(sigma(1, 1) == relative(lambda * trace - 2 * G * 3 * small, 1e-4));
  CHECK(sigma(0, 1) == relative(2 * G * 0.6 * small, 1e-4));
  CHECK((Dim == 2 ? zz : sigma(Dim - 1, Dim - 1)) == relative(lambda * trace, 1e-4));
}

template <int Dim, class L>
void check_derivative(const L& law) {
  for (const auto& F : strained<Dim>()) {
    const Mat<double, Dim> P = law.piola(F, determinant(F));
    CHECK(greatest(P) > 0.01 * G);
    CHECK(greatest(minus(P, slope_of_energy(law, F))) < 1e-8 * greatest(P));
  }
}

template <int Dim, class L>
void check_cauchy(const L& law) {
  for (const auto& F : strained<Dim>()) {
    const double J = determinant(F);
    const Mat<double, Dim> P = law.piola(F, J), sigma = combination(1 / J, times(P, transposed(F)), 0.0, P);
    CHECK(greatest(minus(sigma, transposed(sigma))) < 1e-12 * greatest(sigma));
    CHECK(greatest(minus(sigma, full(law.cauchy(F, J).sigma))) < 1e-12 * greatest(sigma));
  }
}

/// Greatest of |P(Q F) − Q P(F)|, |ψ(Q F) − ψ(F)| and |σ_zz(Q F) − σ_zz(F)|, divided by |P(F)|.
template <int Dim, class L>
double lack_of_objectivity(const L& law) {
  double lack = 0;
  for (const auto& F : strained<Dim>()) {
    for (const double angle : {0.3, 1.9, 3.1, -2.5}) {
      const Mat<double, Dim> Q = turn<Dim>(angle), QF = times(Q, F);
      const double J = determinant(F), scale = greatest(law.piola(F, J));
      lack = std::max(lack, greatest(minus(law.piola(QF, J), times(Q, law.piola(F, J)))) / scale);
      lack = std::max(lack, std::abs(law.energy(QF, J) - law.energy(F, J)) / scale);
      lack = std::max(lack, std::abs(law.cauchy(QF, J).zz - law.cauchy(F, J).zz) / scale);
    }
  }
  return lack;
}

M3 in_space(const M2& F) { return {{{F(0, 0), F(0, 1), 0}, {F(1, 0), F(1, 1), 0}, {0, 0, 1}}}; }

template <class L>
void check_plane(const L& law, double J_per_det = 1) {
  for (const M2& F : strained<2>()) {
    const double J = J_per_det * determinant(F);
    const M2 P = law.piola(F, J);
    const M3 of_space = law.piola(in_space(F), J);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) CHECK(std::abs(P(a, b) - of_space(a, b)) < 1e-12 * greatest(P));
    CHECK(law.energy(F, J) == relative(law.energy(in_space(F), J), 1e-12));
    CHECK(law.cauchy(F, J).zz == relative(law.cauchy(in_space(F), J).sigma(2, 2), 1e-10));
  }
}

M2 rate_of_cofactor(const M2&, const M2& rate) { return cofactor(rate); }
M3 rate_of_cofactor(const M3& F, const M3& rate) { return tensor_cross(F, rate); }

/// Checks P(F, cof F, J) = P(F, J), and that P is the slope of ψ(F, H, J) along the rates of [Lee2016] Eq. 33.
template <int Dim, class L>
void check_own_cofactor(const L& law) {
  constexpr double step = 1e-6;
  for (const auto& F : strained<Dim>()) {
    const double J = determinant(F), J_own = 1.03 * J;
    const Mat<double, Dim> cof = cofactor(F), P = law.piola(F, J);
    CHECK(greatest(minus(law.piola(F, cof, J), P)) <= 1e-15 * greatest(P));
    Mat<double, Dim> H = cof;
    H(0, 0) *= 1.05, H(1, 0) += 0.1;
    const Mat<double, Dim> own = law.piola(F, H, J_own);
    CHECK(greatest(minus(own, P)) > 0.01 * greatest(P));
    for (int a = 0; a < Dim; ++a) {
      for (int b = 0; b < Dim; ++b) {
        Mat<double, Dim> rate{};
        rate(a, b) = 1;
        const auto energy = [&](double t) {
          const double of_volume = t * contraction(H, rate), volume = J_own + of_volume - 1;
          return law.shear_energy(combination(1.0, F, t, rate),
                                  combination(1.0, H, t, rate_of_cofactor(F, rate)),
                                  (law.J_in_shear ? J_own : J) + of_volume) +
                 0.5 * K * volume * volume;
        };
        CHECK(std::abs((energy(step) - energy(-step)) / (2 * step) - own(a, b)) < 1e-7 * greatest(own));
      }
    }
  }
}

}  // namespace

TEST_SUITE("term") {
  TEST_CASE("laws: the stress is zero at rest and Hooke's for small strains") {
    const auto check = [](const auto& law) {
      check_rest<2>(law);
      check_rest<3>(law);
      check_small_strain<2>(law);
      check_small_strain<3>(law);
    };
    check(LawOf<Law::neo_hookean>{{K, G}});
    for (const double share : {0.0, 0.3, 1.0}) check(LawOf<Law::mooney_rivlin>{{K, G, share}});
    check(LawOf<Law::st_venant_kirchhoff>{{K, G}});
    check(LawOf<Law::linear_elastic>{{K, G}});
    check(LawOf<Law::rotated_piola>{{K, G}});
  }

  TEST_CASE("laws: P is the derivative of the energy, except for icb's rotated stress") {
    const auto check = [](const auto& law) {
      check_derivative<2>(law);
      check_derivative<3>(law);
    };
    check(LawOf<Law::neo_hookean>{{K, G}});
    for (const double share : {0.0, 0.3, 1.0}) check(LawOf<Law::mooney_rivlin>{{K, G, share}});
    check(LawOf<Law::st_venant_kirchhoff>{{K, G}});
    check(LawOf<Law::linear_elastic>{{K, G}});
    const LawOf<Law::rotated_piola> turned{{K, G}};
    const M2 F = strained<2>()[0];
    const M2 P = turned.piola(F, determinant(F));
    CHECK(greatest(minus(P, slope_of_energy(turned, F))) > 0.1 * greatest(P));
  }

  TEST_CASE("laws: for all but the linear law, P Fᵀ/J is the symmetric Cauchy stress") {
    const auto check = [](const auto& law) {
      check_cauchy<2>(law);
      check_cauchy<3>(law);
    };
    check(LawOf<Law::neo_hookean>{{K, G}});
    check(LawOf<Law::mooney_rivlin>{{K, G, 0.6}});
    check(LawOf<Law::st_venant_kirchhoff>{{K, G}});
    check(LawOf<Law::rotated_piola>{{K, G}});
  }

  TEST_CASE("laws: every law but the linear one is objective") {
    const auto lack = [](const auto& law) {
      return std::max(lack_of_objectivity<2>(law), lack_of_objectivity<3>(law));
    };
    CHECK(lack(LawOf<Law::neo_hookean>{{K, G}}) < 1e-12);
    CHECK(lack(LawOf<Law::mooney_rivlin>{{K, G, 0.6}}) < 1e-12);
    CHECK(lack(LawOf<Law::st_venant_kirchhoff>{{K, G}}) < 1e-12);
    CHECK(lack(LawOf<Law::rotated_piola>{{K, G}}) < 1e-12);
    CHECK(lack_of_objectivity<2>(LawOf<Law::linear_elastic>{{K, G}}) > 0.1);
    CHECK(lack_of_objectivity<3>(LawOf<Law::linear_elastic>{{K, G}}) > 0.1);
  }

  TEST_CASE("laws: a law in plane strain equals the 3D law with F_zz = 1") {
    check_plane(LawOf<Law::neo_hookean>{{K, G}});
    for (const double share : {0.0, 0.3, 1.0}) check_plane(LawOf<Law::mooney_rivlin>{{K, G, share}});
    for (const bool J_in_shear : {false, true}) {
      check_plane(LawOf<Law::neo_hookean>{{K, G, J_in_shear}}, 1.03);
      check_plane(LawOf<Law::mooney_rivlin>{{K, G, 0.6, J_in_shear}}, 1.03);
    }
    check_plane(LawOf<Law::st_venant_kirchhoff>{{K, G}});
    check_plane(LawOf<Law::linear_elastic>{{K, G}});
  }

  TEST_CASE("laws: with independent H and J, P is the energy's slope along their rates") {
    check_own_cofactor<2>(LawOf<Law::neo_hookean>{{K, G}});
    check_own_cofactor<3>(LawOf<Law::neo_hookean>{{K, G}});
    for (const double share : {0.3, 1.0}) {
      check_own_cofactor<2>(LawOf<Law::mooney_rivlin>{{K, G, share}});
      check_own_cofactor<3>(LawOf<Law::mooney_rivlin>{{K, G, share}});
    }
    check_own_cofactor<2>(LawOf<Law::neo_hookean>{{K, G, true}});
    check_own_cofactor<3>(LawOf<Law::mooney_rivlin>{{K, G, 0.6, true}});
  }

  TEST_CASE("laws: Mooney–Rivlin is neo-Hookean at cofactor_share 0 and depends on areas at 1") {
    const LawOf<Law::neo_hookean> neo{{K, G}};
    const LawOf<Law::mooney_rivlin> none{{K, G, 0}}, all{{K, G, 1}};
    for (const M3& F : strained<3>()) {
      const double J = determinant(F);
      CHECK(greatest(minus(none.piola(F, J), neo.piola(F, J))) < 1e-14 * greatest(neo.piola(F, J)));
      CHECK(none.energy(F, J) == relative(neo.energy(F, J), 1e-12));
    }
    const M3 drawn{{{2, 0, 0}, {0, 1 / std::sqrt(2), 0}, {0, 0, 1 / std::sqrt(2)}}};  // J = 1, |H|² = 4¼
    CHECK(neo.energy(drawn, 1) == relative(0.5 * G * (5 - 3), 1e-12));
    CHECK(all.energy(drawn, 1) == relative(G * (std::pow(4.25, 1.5) / std::pow(3, 1.5) - 1), 1e-12));
  }

  TEST_CASE("laws: the chosen law is used with each material's constants") {
    const std::vector<Elasticity> materials{{1200, 30, K, G, {0.3}}, {1200, 30, 2 * K, G, {0.8}}};
    const M3 F = strained<3>()[1];
    const auto check = [&]<Law L>() {
      const Materials chosen(L, materials);
      for (int m : {0, 1}) {
        const LawOf<L> own = law_of<L>(materials[m]);
        CHECK(greatest(minus(chosen.visit(m, [&](const auto& law) { return law.piola(F, 1.1); }),
                             own.piola(F, 1.1))) == 0);
        const M3 P = chosen.in_use().visit<tl>([&](const auto* laws) { return laws[m].piola(F, 1.1); });
        CHECK(greatest(minus(P, own.piola(F, 1.1))) == 0);
      }
    };
    check.operator()<Law::neo_hookean>();
    check.operator()<Law::mooney_rivlin>();
    check.operator()<Law::st_venant_kirchhoff>();
    check.operator()<Law::linear_elastic>();
    CHECK(may_run_with<oenog, Law::linear_elastic>);
    CHECK(may_run_with<pfj_jst, Law::mooney_rivlin>);
    CHECK_FALSE(may_run_with<pfj_jst, Law::linear_elastic>);
    CHECK_FALSE(may_run_with<tl, Law::rotated_piola>);
    CHECK_FALSE(may_run_with<icb, Law::linear_elastic>);
  }

  TEST_CASE("laws: four packed particles of two materials give the results of single particles") {
    const auto check = []<class L>(const L& law, const L& other) {
      check_four<2>(law, other);
      check_four<3>(law, other);
    };
    check(LawOf<Law::neo_hookean>{{K, G}}, LawOf<Law::neo_hookean>{{2 * K, 3 * G}});
    check(LawOf<Law::mooney_rivlin>{{K, G, 0.4}}, LawOf<Law::mooney_rivlin>{{2 * K, 3 * G, 0.7}});
    check(LawOf<Law::st_venant_kirchhoff>{{K, G}}, LawOf<Law::st_venant_kirchhoff>{{2 * K, 3 * G}});
    check(LawOf<Law::linear_elastic>{{K, G}}, LawOf<Law::linear_elastic>{{2 * K, 3 * G}});
    check(LawOf<Law::rotated_piola>{{K, G}}, LawOf<Law::rotated_piola>{{2 * K, 3 * G}});
  }

  TEST_CASE(
      "laws: the neo-Hookean stress has the pressure −K (J − 1) and the deviator G J^(−5/3) dev(F Fᵀ)") {
    const LawOf<Law::neo_hookean> law{{K, G}};
    for (const M2& F : strained<2>()) {
      const double J = determinant(F), scale = G * std::pow(J, -5.0 / 3);
      const M2 b = times(F, transposed(F));
      const double mean = (b(0, 0) + b(1, 1) + 1) / 3;
      const auto [sigma, zz] = law.cauchy(F, J);
      CHECK(sigma(0, 0) == relative(K * (J - 1) + scale * (b(0, 0) - mean), 1e-12));
      CHECK(sigma(0, 1) == relative(scale * b(0, 1), 1e-12));
      CHECK(zz == relative(K * (J - 1) + scale * (1 - mean), 1e-12));
    }
  }

  TEST_CASE("laws: the rotation nearest to F is found in 2D and 3D, also for half turns") {
    for (const double angle : {0.0, 0.4, 2.0, 3.1, -1.7}) {
      const M2 R = rotation(angle), U{{{1.4, 0.2}, {0.2, 0.6}}};
      CHECK(greatest(minus(nearest_rotation(times(R, U)), R)) < 1e-14);
    }
    const M2 reflection{{{1, 0}, {0, -1}}};  // all rotations are equally near
    CHECK(greatest(minus(nearest_rotation(reflection), M2{{{1, 0}, {0, 1}}})) == 0);
    // for half turns the iteration starts with zero torque
    const M3 U{{{1.4, 0.2, 0.1}, {0.2, 0.6, -0.1}, {0.1, -0.1, 0.9}}};
    for (const Vec<double, 3>& axis : {Vec<double, 3>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.36, -0.48, 0.8}}) {
      for (const double off : {0.0, 1e-7, -1e-3}) {
        const double angle = std::numbers::pi + off;
        const M3 R = turned_by(angle * axis, angle, identity<3>());
        for (const M3& stretch : {identity<3>(), U})
          CHECK(greatest(minus(nearest_rotation(times(R, stretch)), R)) < 1e-12);
      }
    }
    const M2 nothing{};
    CHECK(greatest(minus(nearest_rotation(nothing), M2{{{1, 0}, {0, 1}}})) == 0);
  }
}

}  // namespace of_this_file
