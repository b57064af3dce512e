#include <cmath>

#include <doctest/doctest.h>

#include "engine/kernels/kernel.hpp"
#include "engine/terms/artificial_stress.hpp"
#include "engine/terms/equation_of_state.hpp"
#include "engine/terms/gradient_correction.hpp"
#include "engine/terms/riemann.hpp"
#include "engine/terms/shear.hpp"
#include "engine/terms/stress_rate.hpp"
#include "engine/terms/velocity_gradient.hpp"
#include "tests/support/made_pair.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

struct Units {
  double length, time, mass;

  double speed() const { return length / time; }
  double acceleration() const { return length / (time * time); }
  double area() const { return length * length; }
  double density() const { return mass / (length * length * length); }
  double pressure() const { return mass / (length * time * time); }
  double mass_per_depth() const { return mass / length; }
  double slope() const { return 1 / (length * length * length); }  // ∂W/∂r in 2D
};

const Units others[] = {{10, 1, 1}, {1, 10, 1}, {1, 1, 10}, {3, 0.25, 7}};

struct Results {
  Vec<double, 2> nested, laplacian, plain, repulsion;
  double riemann, compression, diffusion, eos;
  Mat<double, 2> L{};
  Sym<double, 2> moment{}, rate, R;

  explicit Results(const Units& u) {
    PairedParticle i = in_units(first_of_pair, u), j = in_units(second_of_pair, u);
    const double dW = slope_of_pair * u.slope(), rho0 = 1.3 * u.density(), c0 = 4 * u.speed();
    const double G = 2.1 * u.pressure();
    const Seen g(i, j);
    nested = nested_shear_term(i.s, j.s, j.V, dW, g.e);
    laplacian = laplacian_term(g.v_ij, j.V, dW, g.inv_r, g.e);
    plain = laplacian_term_nonconservative(g.v_ij, j.V, dW, g.inv_r);
    riemann = riemann_pressure(i.p, j.p, g.closing_speed, {rho0 * c0, 0.1 / c0, 0.05});
    compression = compression_term(j.V, dW, g.closing_speed);
    diffusion = pressure_diffusion_term(j.V, dW, i.p, j.p, 1, rho0, c0);
    eos = pressure(1.1 * rho0, rho0, c0);
    add_velocity_gradient(L, j.V, dW, g.v_ij, g.e);
    add_gradient_moment(moment, j.V, dW, g.r, g.e);
    rate = jaumann_rate<Deviator::in_plane>(L, i.s, G);
    R = artificial_stress(i.s, i.rho(), 0.3);
    repulsion = artificial_stress_term(R, artificial_stress(j.s, j.rho(), 0.3), j.m, 0.6, dW, g.e);
  }

  static PairedParticle in_units(const PairedParticle& p, const Units& u) {
    return {u.length * p.x, u.speed() * p.v,    u.mass_per_depth() * p.m,
            u.area() * p.V, u.pressure() * p.p, u.pressure() * p.s};
  }
};

}  // namespace

TEST_SUITE("term") {
  TEST_CASE("units: results of the terms have the stated units") {
    const Results si({1, 1, 1});
    CHECK(si.nested[0] * si.laplacian[0] * si.plain[0] * si.repulsion[0] != 0);
    CHECK(si.compression * si.diffusion * si.riemann * si.eos * si.L(0, 1) * si.moment(0, 0) != 0);
    CHECK(si.R(0, 0) * si.rate(0, 0) != 0);
    for (const Units& u : others) {
      CAPTURE(u.length);
      CAPTURE(u.time);
      CAPTURE(u.mass);
      const Results r(u);
      for (int k = 0; k < 2; ++k) {
        CHECK(r.nested[k] == relative(u.pressure() / u.length * si.nested[k]));        // N/m³
        CHECK(r.laplacian[k] == relative(1 / (u.length * u.time) * si.laplacian[k]));  // 1/(m s)
        CHECK(r.plain[k] == relative(1 / (u.length * u.time) * si.plain[k]));          // 1/(m s)
        CHECK(r.repulsion[k] == relative(u.acceleration() * si.repulsion[k]));         // m/s²
        CHECK(r.L(0, k) == relative(1 / u.time * si.L(0, k)));                         // 1/s
      }
      CHECK(r.riemann == relative(u.pressure() * si.riemann));
      CHECK(r.compression == relative(1 / u.time * si.compression));
      CHECK(r.diffusion == relative(1 / u.time * si.diffusion));
      CHECK(r.eos == relative(u.pressure() * si.eos));
      for (int k = 0; k < 3; ++k) {
        CHECK(r.moment.c[k] == relative(si.moment.c[k]));
        CHECK(r.rate.c[k] == relative(u.pressure() / u.time * si.rate.c[k]));
        CHECK(r.R.c[k] == relative(u.pressure() / (u.density() * u.density()) * si.R.c[k]));  // Pa m⁶/kg²
      }
    }
  }
}

}  // namespace of_this_file
