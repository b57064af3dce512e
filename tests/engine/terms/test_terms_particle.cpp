#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/kernels/kernel.hpp"
#include "engine/terms/artificial_stress.hpp"
#include "engine/terms/equation_of_state.hpp"
#include "engine/terms/gradient_correction.hpp"
#include "engine/terms/stress_rate.hpp"
#include "engine/terms/velocity_gradient.hpp"
#include "tests/support/made_pair.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

using Mat2 = Mat<double, 2>;
using Sym2 = Sym<double, 2>;

struct Cloud {
  std::vector<Vec<double, 2>> x;
  std::vector<double> V;

  explicit Cloud(unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> jitter(-0.25, 0.25);
    for (int a = -3; a <= 3; ++a) {
      for (int b = -1; b <= 3; ++b) {  // one-sided, as at a surface
        if (a == 0 && b == 0) continue;
        x.push_back({a + jitter(generator), b + jitter(generator)});
        V.push_back(1 + jitter(generator));
      }
    }
  }
};

constexpr double h = 1.3;

struct Gradient {
  Mat2 L{};
  Sym2 moment{};
};

Gradient gradient_of(const Cloud& cloud, const Vec<double, 2>& v0, const Mat2& A) {
  using K = Kernel<KernelName::wendland_c2>;
  const auto field = [&](const Vec<double, 2>& x) {
    return Vec<double, 2>{v0[0] + A(0, 0) * x[0] + A(0, 1) * x[1], v0[1] + A(1, 0) * x[0] + A(1, 1) * x[1]};
  };
  Gradient g;
  for (std::size_t j = 0; j < cloud.x.size(); ++j) {
    const double r = magnitude(cloud.x[j]);
    const double dW = K::alpha(2) / (h * h * h) * K::dw(r / h);
    const Vec<double, 2> e = (-1 / r) * cloud.x[j];
    add_velocity_gradient(g.L, cloud.V[j], dW, v0 - field(cloud.x[j]), e);
    add_gradient_moment(g.moment, cloud.V[j], dW, r, e);
  }
  return g;
}

Mat2 rotation(double angle) {
  return {{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}}};
}

/// Q A Qᵀ
Mat2 turned(const Mat2& Q, const Mat2& A) {
  Mat2 B{};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l) B(a, b) += Q(a, k) * A(k, l) * Q(b, l);
  return B;
}
Sym2 turned(const Mat2& Q, const Sym2& s) {
  const Mat2 full = turned(Q, Mat2{{{s(0, 0), s(0, 1)}, {s(0, 1), s(1, 1)}}});
  return {full(0, 0), full(0, 1), full(1, 1)};
}

constexpr double G = 3.7;
const Mat2 some_L = {{{0.4, -1.2}, {0.5, 0.9}}};
const Sym2 some_s = {1.5, -0.6, -1.5};

Sym2 in_plane_rate(const Mat2& L, const Sym2& s) { return jaumann_rate<Deviator::in_plane>(L, s, G); }
Sym2 plane_strain_rate(const Mat2& L, const Sym2& s) { return jaumann_rate<Deviator::plane_strain>(L, s, G); }

/// The principal axis of a is at `angle` to x.
Sym2 principal(double a, double b, double angle) { return turned(rotation(angle), Sym2{a, 0, b}); }

}  // namespace

TEST_SUITE("term") {
  TEST_CASE("equation of state: pressure is positive in compression, with slope c0²") {
    const double rho0 = 1000, c0 = 60;
    CHECK(pressure(rho0, rho0, c0) == 0);
    CHECK(pressure(1.01 * rho0, rho0, c0) == Approx(0.01 * rho0 * c0 * c0));
    CHECK(pressure(0.98 * rho0, rho0, c0) == Approx(-0.02 * rho0 * c0 * c0));
  }

  TEST_CASE("velocity gradient: a linear field on irregular particles is exact after correction") {
    for (const unsigned seed : {1u, 2u, 3u}) {
      const Gradient g = gradient_of(Cloud(seed), {2, -3}, some_L);
      const Mat2 corrected = product(g.L, inverse(g.moment));
      for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b) CHECK(corrected(a, b) == Approx(some_L(a, b)).epsilon(1e-12));
      }
      CHECK(std::abs(g.L(0, 1) - some_L(0, 1)) > 0.01);
    }
  }

  TEST_CASE("velocity gradient: a rigid translation gives 0") {
    const Gradient g = gradient_of(Cloud(4), {2, -3}, {});
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) CHECK(g.L(a, b) == 0);
    CHECK(trace(g.moment) > 1);
  }

  TEST_CASE("velocity gradient: a rigid rotation leaves an unstressed particle unstressed after correction") {
    const Gradient g = gradient_of(Cloud(5), {0, 0}, {{{0, -7}, {7, 0}}});
    const Sym2 raw = in_plane_rate(g.L, {});
    const Sym2 rate = in_plane_rate(product(g.L, inverse(g.moment)), {});
    for (int k = 0; k < 3; ++k) CHECK(std::abs(rate.c[k]) < 1e-12 * G * 7);
    CHECK(std::abs(raw(0, 0)) > 0.01);
  }

  TEST_CASE("stress rate: stretch and shear give values computed by hand, for both deviators") {
    const double a = 0.3;
    const Sym2 stretch = in_plane_rate({{{a, 0}, {0, 0}}}, {});
    CHECK(stretch(0, 0) == Approx(G * a));
    CHECK(stretch(1, 1) == Approx(-G * a));
    CHECK(stretch(0, 1) == 0);
    const Sym2 strain = plane_strain_rate({{{a, 0}, {0, 0}}}, {});
    CHECK(strain(0, 0) == Approx(4.0 / 3 * G * a));
    CHECK(strain(1, 1) == Approx(-2.0 / 3 * G * a));
    CHECK(in_plane_rate({{{0, a}, {0, 0}}}, {})(0, 1) == Approx(G * a));
    CHECK(plane_strain_rate({{{0, 0}, {a, 0}}}, {})(0, 1) == Approx(G * a));
  }

  TEST_CASE("stress rate: the stress of a rotating body rotates with it") {
    const double omega = 5, step = 1e-5;
    const Sym2 rate = in_plane_rate({{{0, -omega}, {omega, 0}}}, some_s);
    const Sym2 after = turned(rotation(omega * step), some_s),
               before = turned(rotation(-omega * step), some_s);
    for (int k = 0; k < 3; ++k) {
      CHECK(rate.c[k] == Approx((after.c[k] - before.c[k]) / (2 * step)).epsilon(1e-6));
      CHECK(std::abs(rate.c[k]) > 1);
    }
  }

  TEST_CASE("stress rate: over many small steps the stress rotates as far as the body") {
    const int steps = 4000;
    const double angle = 1;
    const Mat2 spin = {{{0, -angle / steps}, {angle / steps, 0}}};
    Sym2 s = some_s;
    for (int k = 0; k < steps; ++k) {
      const Sym2 middle = s + 0.5 * in_plane_rate(spin, s);
      s += in_plane_rate(spin, middle);
    }
    const Sym2 expected = turned(rotation(angle), some_s);
    for (int k = 0; k < 3; ++k) CHECK(s.c[k] == Approx(expected.c[k]).epsilon(2e-6));
    CHECK(std::abs(s(0, 0) - some_s(0, 0)) > 1);
  }

  TEST_CASE("stress rate: the rate in rotated axes is the rotated rate") {
    const Mat2 Q = rotation(1.1);
    const Sym2 expected = turned(Q, in_plane_rate(some_L, some_s));
    const Sym2 rate = in_plane_rate(turned(Q, some_L), turned(Q, some_s));
    for (int k = 0; k < 3; ++k) {
      CHECK(std::abs(rate.c[k]) > 0.1);
      CHECK(rate.c[k] == Approx(expected.c[k]));
    }
  }

  TEST_CASE("stress rate: a deviator stays a deviator") {
    CHECK(trace(in_plane_rate(some_L, some_s)) == Approx(0));
    const double divergence = some_L(0, 0) + some_L(1, 1);  // s_zz takes the rest
    CHECK(trace(plane_strain_rate(some_L, some_s)) == Approx(2.0 / 3 * G * divergence));
    const Mat<double, 3> L = {{{0.4, -1.2, 0.3}, {0.5, 0.9, -0.8}, {0.2, 1.1, 0.6}}};
    const Sym<double, 3> s = {1, 0.5, -0.3, 2, 0.7, -3};
    const auto rate = jaumann_rate<Deviator::plane_strain>(L, s, G);
    CHECK(trace(rate) == Approx(0).scale(1));
    CHECK(std::abs(rate(0, 0)) > 0.1);
    CHECK(rate(0, 1) == jaumann_rate<Deviator::in_plane>(L, s, G)(0, 1));
  }

  TEST_CASE("artificial stress: the positive part keeps the axes and the positive principal stresses") {
    for (const double angle : {0.0, 0.3, 0.25 * std::numbers::pi, 1.4, 2.9}) {
      for (const auto& [a, b] : {std::pair{4.0, -3.0},
                                 {-3.0, 4.0},
                                 {4.0, 2.0},
                                 {-4.0, -2.0},
                                 {4.0, 0.0},
                                 std::pair{1e-9, -5.0},
                                 {3.0, 3.0},
                                 {-3.0, -3.0},
                                 {0.0, 0.0}}) {
        CAPTURE(angle);
        const auto& a_now = a;  // clang cannot capture bindings
        CAPTURE(a_now);
        const auto& b_now = b;
        CAPTURE(b_now);
        const Sym2 expected = principal(std::max(a, 0.0), std::max(b, 0.0), angle);
        const Sym2 found = positive_part(principal(a, b, angle));
        for (int k = 0; k < 3; ++k) CHECK(std::abs(found.c[k] - expected.c[k]) < 1e-14 * 5);
      }
    }
  }

  TEST_CASE("artificial stress: the value is −ε σ⁺/ρ², and 0 in compression") {
    const Sym2 R = artificial_stress(principal(6, -2, 0.4), 2.0, 0.3);
    const Sym2 expected = principal(-0.3 * 6 / 4, 0, 0.4);
    for (int k = 0; k < 3; ++k) CHECK(R.c[k] == Approx(expected.c[k]));
    for (const double component : artificial_stress(principal(-6, -2, 0.4), 2.0, 0.3).c)
      CHECK(component == 0);
    for (const double component : artificial_stress(principal(6, 2, 0.4), 2.0, 0.0).c) CHECK(component == 0);
  }

  TEST_CASE("artificial stress: a stretched pair is repelled, more strongly when closer") {
    const Seen g(first_of_pair, second_of_pair);
    const Sym2 R = artificial_stress(Sym2{5, 0, 5}, 2.0, 0.3);
    const auto push = [&](double closeness) {
      return dot(artificial_stress_term(R, R, second_of_pair.m, closeness, slope_of_pair, g.e), g.e);
    };
    CHECK(push(1) == Approx(second_of_pair.m * slope_of_pair * 2 * -0.3 * 5 / 4));
    CHECK(push(1) > 0);
    CHECK(push(0.5) == Approx(0.5 * push(1)));
  }

  TEST_CASE("artificial stress: the printed weight of [TranDuc2023] grows with the distance") {
    const Pack r = {0.5, 1, 2, 3}, weight = distance_weight(r, 2.0, 6);
    CHECK(weight[2] == 1);
    CHECK(weight[0] == Approx(1 / 4096.0));
    CHECK(weight[1] == Approx(1 / 64.0));
    CHECK(weight[3] == Approx(729 / 64.0));
  }
}

}  // namespace of_this_file
