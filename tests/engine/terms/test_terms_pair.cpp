#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/kernels/kernel.hpp"
#include "engine/terms/artificial_stress.hpp"
#include "engine/terms/riemann.hpp"
#include "engine/terms/shear.hpp"
#include "tests/support/made_pair.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

/// A term as the force of j on i.
struct ForceTerm {
  std::string name;
  Vec<double, 2> (*force)(const PairedParticle& i, const PairedParticle& j);
};

constexpr double dW = slope_of_pair;
constexpr Dissipation half_limited{/*ρ0 c0*/ 2.5, /*slope*/ 0.1, /*least*/ 0.2};

const ForceTerm force_terms[] = {
    {"pressure",
     [](const PairedParticle& i, const PairedParticle& j) {
       const Seen g(i, j);
       return (-2 * i.V * j.V * dW * riemann_pressure(i.p, j.p, g.closing_speed, half_limited)) * g.e;
     }},
    {"nested shear",
     [](const PairedParticle& i, const PairedParticle& j) {
       return i.V * nested_shear_term(i.s, j.s, j.V, dW, Seen(i, j).e);
     }},
    {"laplacian",
     [](const PairedParticle& i, const PairedParticle& j) {
       const Seen g(i, j);
       return i.V * laplacian_term(g.v_ij, j.V, dW, g.inv_r, g.e);
     }},
    {"laplacian, nonconservative",
     [](const PairedParticle& i, const PairedParticle& j) {
       const Seen g(i, j);
       return i.V * laplacian_term_nonconservative(g.v_ij, j.V, dW, g.inv_r);
     }},
    {"artificial stress",
     [](const PairedParticle& i, const PairedParticle& j) {
       const auto R_i = artificial_stress(i.s, i.rho(), 0.3), R_j = artificial_stress(j.s, j.rho(), 0.3);
       return i.m * artificial_stress_term(R_i, R_j, j.m, 0.6, dW, Seen(i, j).e);
     }},
};

/// Sum of `term` over a fine lattice.
template <class Field, class Term>
Vec<double, 2> operator_at_origin(const Field& v, const Term& term) {
  using K = Kernel<KernelName::wendland_c2>;
  const double h = 0.1, spacing = h / 16;
  Vec<double, 2> sum{};
  for (int a = -32; a <= 32; ++a) {
    for (int b = -32; b <= 32; ++b) {
      if (a == 0 && b == 0) continue;
      const Vec<double, 2> x_j = {a * spacing, b * spacing};
      const double r = std::sqrt(dot(x_j, x_j));
      const double slope = K::alpha(2) / (h * h * h) * K::dw(r / h);
      sum += term(v(Vec<double, 2>{}) - v(x_j), spacing * spacing, slope, 1 / r, (-1 / r) * x_j);
    }
  }
  return sum;
}

Vec<double, 2> laplacian_at_origin(Vec<double, 2> (*v)(const Vec<double, 2>&)) {
  return operator_at_origin(v, laplacian_term<double, 2>);
}

Vec<double, 2> plain_laplacian_at_origin(Vec<double, 2> (*v)(const Vec<double, 2>&)) {
  return operator_at_origin(v, [](const auto& v_ij, double V_j, double slope, double inv_r, const auto&) {
    return laplacian_term_nonconservative(v_ij, V_j, slope, inv_r);
  });
}

constexpr double quadrature_error = 2e-3;

}  // namespace

TEST_SUITE("term") {
  TEST_CASE("force: the forces of j on i and of i on j are opposite") {
    for (const ForceTerm& term : force_terms) {
      CAPTURE(term.name);
      const Vec<double, 2> on_i = term.force(first_of_pair, second_of_pair);
      const Vec<double, 2> on_j = term.force(second_of_pair, first_of_pair);
      CHECK(magnitude(on_i) > 0.01);
      for (int k = 0; k < 2; ++k) CHECK(on_i[k] == Approx(-on_j[k]));
    }
  }

  TEST_CASE("force: pressure and Laplacian act along the pair, and other force terms do not") {
    const Seen g(first_of_pair, second_of_pair);
    const auto across = [&](int term) {
      const Vec<double, 2> f = force_terms[term].force(first_of_pair, second_of_pair);
      return std::abs(f[0] * g.e[1] - f[1] * g.e[0]) / magnitude(f);
    };
    CHECK(across(0) < 1e-15);  // pressure
    CHECK(across(2) < 1e-15);  // laplacian
    CHECK(across(1) > 0.1);    // the others have a torque
    CHECK(across(3) > 0.1);
    CHECK(across(4) > 0.1);
  }

  TEST_CASE("shear: a rigid translation gives 0") {
    PairedParticle j = second_of_pair;
    j.v = first_of_pair.v;
    const Seen g(first_of_pair, j);
    CHECK(magnitude(laplacian_term(g.v_ij, j.V, dW, g.inv_r, g.e)) == 0);
    CHECK(magnitude(laplacian_term_nonconservative(g.v_ij, j.V, dW, g.inv_r)) == 0);
  }

  TEST_CASE("shear: a rigid rotation gives 0, except with the nonconservative Laplacian") {
    const double omega = 40;
    const PairedParticle j = turning_with(first_of_pair, second_of_pair, omega);
    const Seen g(first_of_pair, j);
    CHECK(magnitude(g.v_ij) == Approx(omega * g.r));
    const double plain = magnitude(laplacian_term_nonconservative(g.v_ij, j.V, dW, g.inv_r));
    CHECK(plain == Approx(2 * j.V * std::abs(dW) * omega));
    CHECK(magnitude(laplacian_term(g.v_ij, j.V, dW, g.inv_r, g.e)) < 1e-14 * plain);
  }

  TEST_CASE("shear: the terms of a pair along x have values computed by hand") {
    const Vec<double, 2> e = {1, 0}, v_ij = {3, 5};
    const Vec<double, 2> f = laplacian_term(v_ij, 0.5, -4.0, 10.0, e);
    CHECK(f[0] == Approx(2 * 0.5 * -4 * 10 * 3));
    CHECK(f[1] == 0);
    const Vec<double, 2> plain = laplacian_term_nonconservative(v_ij, 0.5, -4.0, 10.0);
    CHECK(plain[0] == Approx(2 * 0.5 * -4 * 10 * 3));
    CHECK(plain[1] == Approx(2 * 0.5 * -4 * 10 * 5));
    const Vec<double, 2> nested = nested_shear_term<double, 2>({1, 2, 3}, {10, 20, 30}, 0.5, -4.0, e);
    CHECK(nested[0] == Approx(0.5 * -4 * 11));
    CHECK(nested[1] == Approx(0.5 * -4 * 22));
  }

  TEST_CASE("laplacian: the continuum limit is (∇²v + 2 ∇∇·v)/(d + 2), and ∇²v for the plain Laplacian") {
    const auto stretch = [](const Vec<double, 2>& x) { return Vec<double, 2>{x[0] * x[0], 0}; };
    const auto shear = [](const Vec<double, 2>& x) { return Vec<double, 2>{x[1] * x[1], 0}; };
    const auto mixed = [](const Vec<double, 2>& x) { return Vec<double, 2>{0, x[0] * x[1]}; };
    CHECK(laplacian_at_origin(stretch)[0] == Approx((2 + 2 * 2) / 4.0).epsilon(quadrature_error));
    CHECK(laplacian_at_origin(shear)[0] == Approx(2 / 4.0).epsilon(quadrature_error));
    CHECK(laplacian_at_origin(mixed)[0] == Approx(2 * 1 / 4.0).epsilon(quadrature_error));  // ∇·v = x
    CHECK(laplacian_at_origin(mixed)[1] == Approx(0).scale(1).epsilon(quadrature_error));
    CHECK(plain_laplacian_at_origin(stretch)[0] == Approx(2).epsilon(quadrature_error));
    CHECK(plain_laplacian_at_origin(shear)[0] == Approx(2).epsilon(quadrature_error));
    CHECK(plain_laplacian_at_origin(mixed)[0] == Approx(0).epsilon(quadrature_error));
  }

  TEST_CASE("riemann: P* is symmetric in the two states") {
    const Seen ij(first_of_pair, second_of_pair), ji(second_of_pair, first_of_pair);
    CHECK(ij.closing_speed > 0.1);
    CHECK(ij.closing_speed == ji.closing_speed);
    const double p = riemann_pressure(first_of_pair.p, second_of_pair.p, ij.closing_speed, half_limited);
    CHECK(p == riemann_pressure(second_of_pair.p, first_of_pair.p, ji.closing_speed, half_limited));
    CHECK(p != 0.5 * (first_of_pair.p + second_of_pair.p));
  }

  TEST_CASE("riemann: β lies between its least value and 1") {
    const double impedance = 7, c0 = 10, limiter = 3, mean = 0.5 * (4 + 2);
    const auto dissipation_of = [&](double closing, double least) {
      const double p = riemann_pressure(4.0, 2.0, closing, {impedance, limiter / c0, least});
      return 2 * (p - mean) / (impedance * closing);  // β
    };
    CHECK(dissipation_of(1, 0) == Approx(limiter * 1 / c0));
    CHECK(dissipation_of(2, 0) == Approx(limiter * 2 / c0));
    CHECK(dissipation_of(2, 0.7) == Approx(0.7));
    CHECK(dissipation_of(5, 0) == Approx(1));
    CHECK(dissipation_of(-1, 0) == Approx(0));  // separating pairs are not attracted
    CHECK(dissipation_of(-1, 0.4) == Approx(0.4));
    CHECK(dissipation_of(0.01, 1) == Approx(1));
    CHECK(dissipation_of(-9, 1) == Approx(1));
    CHECK(riemann_pressure(4.0, 2.0, 0.0, {impedance, limiter / c0, 1}) == Approx(mean));
  }

  TEST_CASE("riemann: approaching pairs grow denser, and rotating pairs do not") {
    const Seen g(first_of_pair, second_of_pair);
    CHECK(g.closing_speed > 0);
    CHECK(compression_term(second_of_pair.V, dW, g.closing_speed) ==
          Approx(second_of_pair.V * dW * dot(g.v_ij, g.e)));
    CHECK(compression_term(second_of_pair.V, dW, g.closing_speed) > 0);
    const PairedParticle turning = turning_with(first_of_pair, second_of_pair, 40);
    CHECK(std::abs(compression_term(turning.V, dW, Seen(first_of_pair, turning).closing_speed)) < 1e-13);
  }

  TEST_CASE("riemann: pressure diffusion flows from the higher pressure to the lower") {
    const auto flow = [](double p_i, double p_j, double share) {
      return pressure_diffusion_term(0.9, dW, p_i, p_j, share, /*ρ0*/ 2.0, /*c0*/ 5.0);
    };
    CHECK(flow(8, 3, 1) == Approx(0.9 * dW * (8 - 3) / (2 * 5)));
    CHECK(flow(8, 3, 1) < 0);  // the density of i falls
    CHECK(flow(8, 3, 1) == -flow(3, 8, 1));
    CHECK(flow(8, 3, 0.25) == Approx(0.25 * flow(8, 3, 1)));
    CHECK(flow(8, 3, 0) == 0);
    CHECK(flow(8, 8, 1) == 0);
  }

  TEST_CASE("pair terms: four packed pairs equal single ones to the last bit") {
    const Pack V = {0.9, 1.1, 0.4, 0}, slope = {-0.8, -0.1, 0, -2}, inv_r = {3, 1, 0.2, 0};
    const Pack speed = {0.3, -2, 40, 0}, p_i = {1, 2, 3, 4}, p_j = {-5, 0.1, 7, 4};
    const Vec<Pack, 2> e = {Pack{0.6, 1, 0, -0.8}, Pack{-0.8, 0, 1, 0.6}};
    const Vec<Pack, 2> v = {Pack{1, -2, 3, 0.5}, Pack{0.1, 5, -3, 2}};
    const Sym<Pack, 2> s = {p_i, p_j, speed}, t = {speed, V, p_j};
    const auto lap = laplacian_term(v, V, slope, inv_r, e);
    const auto plain = laplacian_term_nonconservative(v, V, slope, inv_r);
    const auto nested = nested_shear_term(s, t, V, slope, e);
    const auto repulsion = artificial_stress_term(s, t, V, inv_r, slope, e);
    const Pack p = riemann_pressure(p_i, p_j, speed, half_limited);
    const Pack c = compression_term(V, slope, speed);
    const Pack d = pressure_diffusion_term(V, slope, p_i, p_j, 0.7, 2.0, 5.0);
    for (int l = 0; l < lanes; ++l) {
      const Vec<double, 2> e1 = {e[0][l], e[1][l]}, v1 = {v[0][l], v[1][l]};
      const Sym<double, 2> s1 = {p_i[l], p_j[l], speed[l]}, t1 = {speed[l], V[l], p_j[l]};
      const double V1 = V[l], W1 = slope[l], i1 = inv_r[l], u1 = speed[l], a1 = p_i[l], b1 = p_j[l];
      for (int k = 0; k < 2; ++k) {
        CHECK(lap[k][l] == laplacian_term(v1, V1, W1, i1, e1)[k]);
        CHECK(plain[k][l] == laplacian_term_nonconservative(v1, V1, W1, i1)[k]);
        CHECK(nested[k][l] == nested_shear_term(s1, t1, V1, W1, e1)[k]);
        CHECK(repulsion[k][l] == artificial_stress_term(s1, t1, V1, i1, W1, e1)[k]);
      }
      CHECK(p[l] == riemann_pressure(a1, b1, u1, half_limited));
      CHECK(c[l] == compression_term(V1, W1, u1));
      CHECK(d[l] == pressure_diffusion_term(V1, W1, a1, b1, 0.7, 2.0, 5.0));
    }
  }
}

}  // namespace of_this_file
