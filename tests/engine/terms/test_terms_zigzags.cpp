#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "engine/kernels/kernel.hpp"
#include "engine/materials/neo_hookean.hpp"
#include "engine/terms/hourglass/hourglass_force.hpp"
#include "engine/terms/hourglass/pair_shear.hpp"
#include "engine/terms/hourglass/velocity_penalty.hpp"
#include "tests/support/made_pair.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

using V2 = Vec<double, 2>;
using M2 = Mat<double, 2>;

constexpr M2 stretched_and_turned{{{1.2, -0.5}, {0.4, 0.9}}};
constexpr V2 X{0.6, 0.5};

double cross_of(const V2& a, const V2& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Penalty of the velocity (−1)^(a + b) e_x at a lattice's origin.
V2 penalty_on_checkerboard(const M2& L_sum, bool central = false) {
  using K = Kernel<KernelName::wendland_c2>;
  const double h = 1.3;
  V2 sum{};
  for (int a = -3; a <= 3; ++a) {
    for (int b = -3; b <= 3; ++b) {
      const V2 x{-double(a), -double(b)};
      const double r = std::sqrt(dot(x, x));
      if (r == 0) continue;
      const double slope = K::alpha(2) / (h * h * h) * K::dw(r / h);
      const V2 v_ij{(a + b) % 2 == 0 ? 0.0 : 2.0, 0};
      const V2 penalty = velocity_penalty_term(v_ij, L_sum, 1.0, slope / r, (slope / r) * x);
      sum += central ? central_velocity_penalty_term(penalty, (1 / r) * x) : penalty;
    }
  }
  return sum;
}

}  // namespace

TEST_SUITE("term") {
  TEST_CASE("hourglass force: the force is 0 in an affine motion, acts along pairs and opposes zigzags") {
    const M2& F = stretched_and_turned;
    const V2 x = F * X;
    CHECK(magnitude(hourglass_force(F, F, X, x, 3.0, 2.0)) < 1e-15);
    const M2 D{{{0.1, 0.2}, {-0.3, 0.05}}};
    CHECK(magnitude(hourglass_force(F + D, F + -1.0 * D, X, x, 2.0, 2.0)) < 1e-15);
    const V2 apart = hourglass_force(F, F, X, 1.1 * x, 3.0, 2.0),
             near = hourglass_force(F, F, X, 0.9 * x, 3.0, 2.0);
    CHECK(dot(apart, x) < 0);
    CHECK(dot(near, x) > 0);
    CHECK(magnitude(apart) == relative(0.1 * magnitude(x) * (3 + 2), 1e-12));
    const V2 any{0.7, -0.2};
    const V2 force = hourglass_force(F, D, X, any, 3.0, 2.0);
    CHECK(magnitude(force) > 0.1);
    CHECK(std::abs(cross_of(force, any)) < 1e-15);
    const V2 opposite = hourglass_force(D, F, -1.0 * X, -1.0 * any, 2.0, 3.0);
    CHECK(opposite[0] == -force[0]);
    CHECK(opposite[1] == -force[1]);
    CHECK(magnitude(hourglass_force(F, D, X, V2{}, 3.0, 2.0)) == 0);
  }

  TEST_CASE("hourglass force: other units of length, mass and time rescale the force") {
    for (const double length : {10.0, 0.3}) {
      const double pressure = 7, area = length * length;  // W is in 1/area
      const double w = hourglass_weight(10, 3 * pressure, 0.9 * area, 1.1 * area, 0.4 / area, 0.7 * length);
      CHECK(w == relative(pressure * hourglass_weight(10, 3, 0.9, 1.1, 0.4, 0.7), 1e-14));
      const V2 x{0.5, 0.4};
      const M2& F = stretched_and_turned;
      const V2 one = hourglass_force(F, F, X, x, w, w);
      const V2 other = hourglass_force(F, F, length * X, length * x, w, w);
      CHECK(magnitude(other - length * one) < 1e-13 * magnitude(other));
    }
  }

  TEST_CASE("pair shear: with the shear of pairs the stress is neo-Hookean") {
    const double K = 5, G = 2;
    const M2& F = stretched_and_turned;
    const double J = determinant(F), g = pair_shear_modulus(G, J);
    const M2 P = isotropic_piola(F, M2{}, K, g, 0.0), law = NeoHookean{K, G}.piola(F, J);
    // in a uniform state each pair carries s (P_i + P_j + 2 g F) X
    const V2 by_pairs = pair_shear_force(P, P, g, g, X, F * X, 0.7), by_law = (2 * 0.7) * (law * X);
    CHECK(magnitude(by_law) > 1);
    CHECK(magnitude(by_pairs - by_law) < 1e-13 * magnitude(by_law));
    const V2 opposite = pair_shear_force(P, P, g, g, -1.0 * X, -1.0 * (F * X), 0.7);
    CHECK(opposite[0] == -by_pairs[0]);
    // at rest the two parts cancel, also with the paper's factor
    const M2 one{{{1, 0}, {0, 1}}};
    const M2 rest = isotropic_piola(one, M2{}, K, 1.07 * G, 0.0);
    CHECK(rest(0, 0) == relative(-1.07 * G, 1e-14));
    CHECK(magnitude(pair_shear_force(rest, rest, 1.07 * G, 1.07 * G, X, X, 0.7)) < 1e-14);
    // F = I does not capture the zigzag
    const V2 zigzag{0.05, -0.02};
    const V2 force = pair_shear_force(rest, rest, 1.07 * G, 1.07 * G, X, X + zigzag, -0.7);
    CHECK(dot(force, zigzag) == relative(-0.7 * 2 * 1.07 * G * dot(zigzag, zigzag), 1e-9));
  }

  TEST_CASE("pair shear: damping opposes the strain rate and is 0 in an unstrained rotating body") {
    const M2 one{{{1, 0}, {0, 1}}}, turning{{{0, -3}, {3, 0}}}, stretching{{{2, 0.5}, {0.5, -1}}};
    const double K = 5, g = 2;
    const M2 still = isotropic_piola(one, M2{}, K, g, 0.4), turned = isotropic_piola(one, turning, K, g, 0.4);
    const M2 strained = isotropic_piola(one, stretching, K, g, 0.4);
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) {
        CHECK(std::abs(turned(a, b) - still(a, b)) < 1e-15);
        CHECK(strained(a, b) - still(a, b) == relative(0.4 * stretching(a, b), 1e-12));
      }
    }
  }

  TEST_CASE("velocity penalty: the penalty is 0 for a linear velocity and opposes zigzags") {
    const Seen g(first_of_pair, second_of_pair);
    const V2 x_ij = g.r * g.e;
    const M2 L{{{0.5, -2}, {3, 0.7}}};
    const double slope = slope_of_pair;
    CHECK(magnitude(velocity_penalty_term(L * x_ij, L + L, 1.1, slope * g.inv_r, slope * g.e)) < 1e-14);
    CHECK(magnitude(velocity_penalty_term(L * x_ij, L, 1.1, slope * g.inv_r, slope * g.e)) > 0.1);
    const V2 penalty = penalty_on_checkerboard({});
    CHECK(penalty[0] < -1);
    CHECK(std::abs(penalty[1]) < 1e-14);
  }

  TEST_CASE("velocity penalty: the terms of (i, j) and (j, i) are opposite") {
    const PairedParticle &i = first_of_pair, &j = second_of_pair;
    const Seen of_i(i, j), of_j(j, i);
    const M2 L_sum{{{0.5, -2}, {3, 0.7}}};
    const double slope = slope_of_pair;
    const V2 on_i = i.V * velocity_penalty_term(of_i.v_ij, L_sum, j.V, slope * of_i.inv_r, slope * of_i.e);
    const V2 on_j = j.V * velocity_penalty_term(of_j.v_ij, L_sum, i.V, slope * of_j.inv_r, slope * of_j.e);
    CHECK(magnitude(on_i) > 0.1);
    CHECK(magnitude(on_i + on_j) < 1e-14);
  }

  TEST_CASE("velocity penalty: the central penalty acts along the pair and opposes zigzags") {
    const Seen g(first_of_pair, second_of_pair);
    const V2 x_ij = g.r * g.e;
    const M2 L{{{0.5, -2}, {3, 0.7}}};
    const V2 whole = velocity_penalty_term(g.v_ij, L, 1.1, slope_of_pair * g.inv_r, slope_of_pair * g.e);
    const V2 central = central_velocity_penalty_term(whole, g.e);
    CHECK(std::abs(cross_of(x_ij, whole)) > 0.1);
    CHECK(std::abs(cross_of(x_ij, central)) < 1e-14);
    CHECK(dot(central, g.e) == relative(dot(whole, g.e), 1e-14));
    CHECK(std::abs(dot(central, g.e)) > 0.1);
    const V2 unstrained =
        velocity_penalty_term(L * x_ij, L + L, 1.1, slope_of_pair * g.inv_r, slope_of_pair * g.e);
    CHECK(magnitude(central_velocity_penalty_term(unstrained, g.e)) < 1e-14);
    const V2 on_zigzag = penalty_on_checkerboard({}, true);
    CHECK(on_zigzag[0] ==
          relative(0.5 * penalty_on_checkerboard({})[0], 1e-12));  // mean of e_x² on a square lattice
    CHECK(std::abs(on_zigzag[1]) < 1e-14);
  }

  TEST_CASE("velocity penalty: the spin rotates a vector, whatever the strain rate") {
    const double right_angle = std::numbers::pi / 2;
    const M2 strained_and_turning{{{5, 1 - 2}, {1 + 2, -4}}};  // spin 2
    const V2 turned = rotated_by_spin(strained_and_turning, V2{3, 0}, right_angle / 2);
    CHECK(magnitude(turned - V2{0, 3}) < 1e-14);
    CHECK(rotated_by_spin(M2{{{5, 1}, {1, -4}}}, V2{3, 1}, 0.7)[1] == 1);
    // a third of a turn about (1, 1, 1) exchanges the axes
    const double w = 4 * right_angle / 3 / std::numbers::sqrt3;
    const Mat<double, 3> about_diagonal{{{0, -w, w}, {w, 0, -w}, {-w, w, 0}}};
    const Vec<double, 3> next = rotated_by_spin(about_diagonal, Vec<double, 3>{2, 0, 0}, 1);
    CHECK(std::abs(next[0]) < 1e-14);
    CHECK(next[1] == relative(2, 1e-14));
    CHECK(std::abs(next[2]) < 1e-14);
  }
}

}  // namespace of_this_file
