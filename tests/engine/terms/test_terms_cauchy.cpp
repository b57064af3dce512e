#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "engine/kernels/kernel.hpp"
#include "engine/terms/artificial_viscosity.hpp"
#include "engine/terms/density_diffusion.hpp"
#include "engine/terms/gradient_correction.hpp"
#include "engine/terms/riemann_second_order.hpp"
#include "engine/terms/stress_divergence.hpp"
#include "engine/terms/stress_rate.hpp"
#include "engine/terms/tensile_instability_control.hpp"
#include "engine/terms/velocity_gradient.hpp"
#include "engine/terms/xsph.hpp"
#include "tests/support/made_pair.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

using Vec2 = Vec<double, 2>;
using Mat2 = Mat<double, 2>;
using Sym2 = Sym<double, 2>;

constexpr double dW = slope_of_pair;
constexpr double h = 1.3;  // the spacing of neighbors() is 1
const Mat2 some_L = {{{0.4, -1.2}, {0.5, 0.9}}};

struct Neighbor {
  Vec2 e;
  double r, V, dW;
  Vec2 x() const { return (-r) * e; }
};

std::vector<Neighbor> neighbors() {
  using K = Kernel<KernelName::wendland_c2>;
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> jitter(-0.25, 0.25);
  std::vector<Neighbor> all;
  for (int a = -3; a <= 3; ++a) {
    for (int b = -1; b <= 3; ++b) {
      if (a == 0 && b == 0) continue;
      const Vec2 x = {a + jitter(generator), b + jitter(generator)};
      const double r = magnitude(x);
      all.push_back({(-1 / r) * x, r, 1 + jitter(generator), K::alpha(2) / (h * h * h) * K::dw(r / h)});
    }
  }
  return all;
}

Sym2 correction(const std::vector<Neighbor>& all) {
  Sym2 moment{};
  for (const Neighbor& j : all) add_gradient_moment(moment, j.V, j.dW, j.r, j.e);
  return gradient_correction(moment);
}

template <class Term>
void check_opposite(const Term& term) {
  const Vec2 on_i = term(first_of_pair, second_of_pair), on_j = term(second_of_pair, first_of_pair);
  CHECK(magnitude(on_i) > 1e-3);
  CHECK(magnitude(on_i + on_j) < 1e-15 * magnitude(on_i));
}

}  // namespace

TEST_SUITE("term") {
  TEST_CASE("gradient correction: gradients of linear fields are exact at a surface") {
    const std::vector<Neighbor> all = neighbors();
    Mat2 raw{};
    for (const Neighbor& j : all) {
      const Vec2 v_ij = -1.0 * (some_L * j.x());
      add_velocity_gradient(raw, j.V, j.dW, v_ij, j.e);
    }
    const Mat2 corrected = product(raw, correction(all));
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) CHECK(corrected(a, b) == Approx(some_L(a, b)).epsilon(1e-12));
    CHECK(std::abs(raw(0, 1) - some_L(0, 1)) > 0.1);
  }

  TEST_CASE("gradient correction: the correction is 0 for collinear neighbours") {
    Sym2 moment{};
    add_gradient_moment(moment, 1.0, -0.5, 1.0, Vec2{0.6, 0.8});
    add_gradient_moment(moment, 1.0, -0.5, 2.0, Vec2{-0.6, -0.8});
    CHECK(gradient_correction(moment).c[0] == 0);
    CHECK(gradient_correction(moment).c[2] == 0);
  }

  TEST_CASE(
      "gradient correction: the result is 0 for almost collinear or coplanar neighbours, else the inverse moment") {
    const Sym2 row{1, 0.02, 0.001}, layer_of_two{1, 0, 0.25}, corner{0.3, 0.1, 0.3};
    for (const double c : gradient_correction(row).c) CHECK(c == 0);
    for (const Sym2& M : {layer_of_two, corner})
      for (int k = 0; k < Sym2::size; ++k) CHECK(gradient_correction(M).c[k] == inverse(M).c[k]);
    const Sym<double, 3> layer{1, 0, 0.01, 1, 0.01, 0.003}, edge{0.5, 0, 0, 0.3, 0.1, 0.3};
    for (const double c : gradient_correction(layer).c) CHECK(c == 0);
    for (int k = 0; k < 6; ++k) CHECK(gradient_correction(edge).c[k] == inverse(edge).c[k]);
  }

  TEST_CASE("stress divergence: forces are opposite, and tension attracts") {
    const Mat2 T_i = {{{2, -1}, {0.5, 3}}}, T_j = {{{1, 4}, {-2, 0.3}}};
    check_opposite([&](const PairedParticle& i, const PairedParticle& j) {
      const bool first = i.m == first_of_pair.m;
      return i.V * stress_divergence_term(first ? T_i : T_j, first ? T_j : T_i, j.V, dW, Seen(i, j).e);
    });
    const Mat2 tension = {{{5, 0}, {0, 5}}};
    const Vec2 e = Seen(first_of_pair, second_of_pair).e;
    CHECK(dot(stress_divergence_term(tension, tension, 1.0, dW, e), e) == Approx(10 * dW));
  }

  TEST_CASE("xsph: the transport velocity conserves momentum and angular momentum") {
    const auto term = [](const PairedParticle& i, const PairedParticle& j) {
      return i.m * xsph_term(Seen(i, j).v_ij, i.rho(), j.rho(), j.V, 0.7);
    };
    check_opposite(term);
    // Σ m û × u = 0
    const Vec2 d_i = term(first_of_pair, second_of_pair), d_j = term(second_of_pair, first_of_pair);
    const Vec2 v_i = first_of_pair.v, v_j = second_of_pair.v;
    const double turn = d_i[0] * v_i[1] - d_i[1] * v_i[0] + d_j[0] * v_j[1] - d_j[1] * v_j[0];
    CHECK(std::abs(turn) < 1e-14 * magnitude(d_i) * magnitude(v_i));
    CHECK(dot(d_i, v_j - v_i) > 0);
    CHECK(xsph_term(Vec2{2, 0}, 3.0, 5.0, 0.5, 0.7)[0] == Approx(-2 * 5 * 0.5 / 8 * 0.7 * 2));
  }

  TEST_CASE("artificial viscosity: [Khayyer2024] Eq. 16 slows approaching pairs, but no separating pairs") {
    const double r = 0.8, c = 3, rho = 2, alpha = 1.5, length = 0.9, closing = 0.7;
    const double expected = -alpha * length * c / rho * (closing * r) / (r * r + 0.01 * length * length);
    CHECK(artificial_viscosity(closing * r, r * r, c, rho, alpha, length) == Approx(expected));
    CHECK(artificial_viscosity(-closing * r, r * r, c, rho, alpha, length) == 0);
    check_opposite([](const PairedParticle& i, const PairedParticle& j) {
      const Seen g(i, j);
      REQUIRE(g.closing_speed > 0);
      const double approach = g.closing_speed * g.r, mean = 0.5 * (i.rho() + j.rho());
      const double Pi = artificial_viscosity(approach, g.r * g.r, 3.0, mean, 1.0, 1.0);
      return (i.m * j.m * Pi * dW) * g.e;
    });
  }

  TEST_CASE("density gradient: a linear density is exact after correction") {
    const std::vector<Neighbor> all = neighbors();
    const Vec2 slope = {3, -2};
    Vec2 sum{};
    for (const Neighbor& j : all) sum += density_gradient_term(10.0, 10 + dot(slope, j.x()), j.V, j.dW, j.e);
    const Vec2 gradient = correction(all) * sum;
    CHECK(gradient[0] == Approx(slope[0]).epsilon(1e-12));
    CHECK(gradient[1] == Approx(slope[1]).epsilon(1e-12));
  }

  TEST_CASE("density diffusion: a linear density does not diffuse, others flow from dense to thin") {
    const Vec2 slope = {3, -2};
    for (const Neighbor& j : neighbors()) {
      const double rho_j = 10 + dot(slope, j.x());
      CHECK(std::abs(density_diffusion_term(10.0, rho_j, slope, slope, j.V, j.dW, j.r, j.e)) < 1e-13);
      if (j.r < 2 * h) CHECK(density_diffusion_term(10.0, 11.0, Vec2{}, Vec2{}, j.V, j.dW, j.r, j.e) > 0);
    }
    const double to_i = density_diffusion_term(10.0, 12.0, slope, Vec2{1, 1}, 1.0, dW, 0.5, Vec2{0.6, 0.8});
    const double to_j = density_diffusion_term(12.0, 10.0, Vec2{1, 1}, slope, 1.0, dW, 0.5, Vec2{-0.6, -0.8});
    CHECK(to_i == Approx(-to_j));  // for equal volumes
    CHECK(to_i == Approx(-(2 * 2 + 0.5 * (4 * 0.6 - 1 * 0.8)) * dW / 0.5));
  }

  TEST_CASE("density diffusion: with order 0 a linear density diffuses at a surface") {
    const Vec2 slope = {3, -2};
    double sum = 0;
    for (const Neighbor& j : neighbors()) {
      const double change = dot(slope, j.x());
      const double flow = density_diffusion_term(10.0, 10 + change, Vec2{}, Vec2{}, j.V, j.dW, j.r, j.e);
      CHECK(flow == Approx(-2 * change * j.dW / j.r * j.V));  // [Khayyer2024] Eq. B.3
      sum += flow;
    }
    CHECK(std::abs(sum) > 0.1);
  }

  TEST_CASE("Riemann term: a linear velocity has no dissipation, and forces are opposite") {
    const Sym2 D = symmetric_part(some_L);
    for (const Neighbor& j : neighbors()) {
      const double closing = dot(some_L * j.x(), j.e);  // −v_ij·e
      CHECK(std::abs(closing) > 1e-3);
      CHECK(std::abs(reconstructed_closing_speed(closing, D, D, j.r, j.e)) < 1e-13);
    }
    CHECK(reconstructed_closing_speed(0.7, Sym2{}, Sym2{}, 1.0, Vec2{1, 0}) == 0.7);
    CHECK(riemann_dissipation(0.7, 6.0, 10.0, 1.5, 2.5) == Approx(16.0 / 4 * 0.7));
    // C_ij of equal particles is c ρ
    CHECK(riemann_dissipation(1.0, 3 * 2 * std::sqrt(2.0), 3 * 2 * std::sqrt(2.0), std::sqrt(2.0),
                              std::sqrt(2.0)) == Approx(6));
    check_opposite([&](const PairedParticle& i, const PairedParticle& j) {
      const Seen g(i, j);
      const double speed = reconstructed_closing_speed(g.closing_speed, i.s, j.s, g.r, g.e);
      const double p = riemann_dissipation(speed, i.rho(), j.rho(), std::sqrt(i.rho()), std::sqrt(j.rho()));
      return (-i.V * j.V * p * dW) * g.e;
    });
  }

  TEST_CASE(
      "Riemann term: limiters leave linear velocities undamped and never increase the closing speed of a pair") {
    const Sym2 D = symmetric_part(some_L);
    for (const Limiter limiter : {Limiter::minmod, Limiter::van_leer}) {
      for (const Neighbor& j : neighbors()) {
        const double closing = dot(some_L * j.x(), j.e);
        CHECK(std::abs(limited_closing_speed(closing, D, D, j.r, j.e, limiter)) < 1e-13);
        for (const double factor : {-3.0, 0.2, 0.6, 5.0}) {
          const double share =
              limited_closing_speed(factor * closing, D, D, j.r, j.e, limiter) / (factor * closing);
          CHECK(share > (limiter == Limiter::minmod ? -1e-13 : -1.0));
          CHECK(share <= 1);
        }
      }
      CHECK(limited(2.0, 2.0, limiter) == 2);
      CHECK(limited(2.0, -1.0, limiter) == 0);
    }
    CHECK(limited(2.0, 3.0, Limiter::minmod) == 2);
    CHECK(limited(-3.0, -2.0, Limiter::minmod) == -2);
    CHECK(limited(2.0, 6.0, Limiter::van_leer) == Approx(3));  // harmonic mean
    CHECK(limited_closing_speed(0.7, D, D, 1.0, Vec2{1, 0}, Limiter::first_order) == 0.7);
  }

  TEST_CASE("tensile control: equal tensions exert no force") {
    const std::vector<Neighbor> all = neighbors();
    const Mat2 tension = {{{4, 1}, {2, 3}}};  // σ·L
    Vec2 force{}, sum_gradient{};
    for (const Neighbor& j : all) {
      force += stress_divergence_term(tension, tension, j.V, j.dW, j.e);
      sum_gradient += (j.V * j.dW) * j.e;
    }
    const Vec2 controlled = force + tensile_control(-1.0 * tension, sum_gradient);
    CHECK(magnitude(force) > 0.1);
    CHECK(magnitude(controlled) < 1e-13 * magnitude(force));
  }

  TEST_CASE("colour function: the value is 1 inside a lattice and below 0.9 only on its face") {
    using K = Kernel<KernelName::wendland_c2>;
    const double length = 1.2;
    const auto colour = [&](int rows_above) {
      double C = 0;
      for (int a = -3; a <= 3; ++a)
        for (int b = -3; b <= rows_above; ++b)
          C += colour_term(K::alpha(2) / (length * length) * K::w(std::hypot(a, b) / length), 1.0);
      return C;
    };
    const auto colour_in_3d = [&](int rows_above) {
      double C = 0;
      for (int a = -3; a <= 3; ++a)
        for (int b = -3; b <= rows_above; ++b)
          for (int c = -3; c <= 3; ++c)
            C += colour_term(K::alpha(3) / std::pow(length, 3) * K::w(std::hypot(a, b, c) / length), 1.0);
      return C;
    };
    for (const std::function<double(int)>& C : {std::function(colour), std::function(colour_in_3d)}) {
      CHECK(C(3) == Approx(1).epsilon(0.02));
      CHECK(C(0) < 0.9);
      CHECK(C(1) > 0.9);
    }
  }

  TEST_CASE("rotated stress: a rigid rotation in one step rotates the stress and keeps its magnitude") {
    const Sym2 s = {1.5, -0.6, -0.7};
    const double G = 3.7;
    for (const double angle : {0.01, 0.5, 1.5}) {
      const double rate = 2 * std::tan(0.5 * angle);  // (I − ½ω)⁻¹ (I + ½ω) rotates by this angle
      const Sym2 turned = turned_stress<Deviator::plane_strain>(Mat2{{{0, -rate}, {rate, 0}}}, s, G, 1.0);
      const double c = std::cos(angle), n = std::sin(angle);
      CHECK(turned(0, 0) == Approx(c * c * s(0, 0) - 2 * c * n * s(0, 1) + n * n * s(1, 1)));
      CHECK(turned(1, 1) == Approx(n * n * s(0, 0) + 2 * c * n * s(0, 1) + c * c * s(1, 1)));
      CHECK(turned(0, 1) == Approx(c * n * (s(0, 0) - s(1, 1)) + (c * c - n * n) * s(0, 1)));
    }
    const double dt = 1e-7;  // Jaumann's limit
    const Sym2 rate = jaumann_rate<Deviator::plane_strain>(some_L, s, G);
    const Sym2 next = turned_stress<Deviator::plane_strain>(some_L, s, G, dt);
    for (int k = 0; k < 3; ++k) CHECK((next.c[k] - s.c[k]) / dt == Approx(rate.c[k]).epsilon(1e-5));
  }

  TEST_CASE(
      "rotated stress: in 3D a rigid rotation rotates the stress, and small steps have Jaumann's rate") {
    using Mat3 = Mat<double, 3>;
    const Sym<double, 3> s = {1.5, -0.6, 0.3, -0.7, 0.9, -0.8};
    const Vec<double, 3> axis = {2.0 / 7, 3.0 / 7, 6.0 / 7};
    const Mat3 cross_axis = {{{0, -axis[2], axis[1]}, {axis[2], 0, -axis[0]}, {-axis[1], axis[0], 0}}};
    const double angle = 0.9, G = 3.7;
    const auto turned =
        turned_stress<Deviator::plane_strain>(2 * std::tan(0.5 * angle) * cross_axis, s, G, 1.0);
    Mat3 R = std::sin(angle) * cross_axis + (1 - std::cos(angle)) * product(cross_axis, cross_axis);
    for (int k = 0; k < 3; ++k) R(k, k) += 1;  // Rodrigues
    const Mat3 expected = product_transposed(product(R, s), R);
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) CHECK(turned(k, l) == Approx(expected(k, l)));
    const Mat3 L = {{{0.4, -1.2, 0.3}, {0.5, 0.9, -0.7}, {0.8, 0.2, -0.6}}};
    const double dt = 1e-7;
    const auto rate = jaumann_rate<Deviator::plane_strain>(L, s, G);
    const auto next = turned_stress<Deviator::plane_strain>(L, s, G, dt);
    for (int k = 0; k < 6; ++k) CHECK((next.c[k] - s.c[k]) / dt == Approx(rate.c[k]).epsilon(1e-5));
  }
}

}  // namespace of_this_file
