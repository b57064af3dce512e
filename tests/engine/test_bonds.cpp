// The set-up of oenog's bonds, its energy, and what follows from there being one.

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <doctest/doctest.h>

#include "engine/bonds.hpp"
#include "engine/methods/formulation.hpp"
#include "engine/terms/bond.hpp"
#include "engine/terms/penalty_contact.hpp"
#include "engine/verdict.hpp"
#include "tests/engine/relative.hpp"
#include "tests/engine/runs.hpp"
#include "tests/engine/scenes.hpp"

namespace {

using namespace taut;
using namespace taut::test;
using doctest::Approx;

Bonds bonds_of(const Scene& scene, const Layout& layout) {
  return make_bonds(scene, layout, oenog.h_over_dp * scene.spacing);
}

/// Σ_j w e_x^(4−k) e_y^k of one particle, for k = 0 … 4.
std::array<double, 5> fourth_moments(const Bonds& bonds, int i) {
  std::array<double, 5> sum{};
  for (int b = bonds.begin[i]; b < bonds.begin[i + 1]; ++b) {
    const double r = std::hypot(bonds.X[b][0], bonds.X[b][1]);
    const double ex = bonds.X[b][0] / r, ey = bonds.X[b][1] / r;
    for (int k = 0; k <= 4; ++k) sum[k] += bonds.weight[b] * std::pow(ex, 4 - k) * std::pow(ey, k);
  }
  return sum;
}

/// The neo-Hookean energy of plane strain with principal Green strains m ± d, over G; `K` is over G too.
double neo_hookean(double m, double d, double K) {
  const double J = std::sqrt((1 + 2 * m) * (1 + 2 * m) - 4 * d * d);
  return 0.5 * (std::pow(J, -2.0 / 3) * (3 + 4 * m) - 3) + 0.5 * K * (J - 1) * (J - 1);
}

/// The same of bonds in all directions and U.
double bonded(double m, double d, double K) {
  constexpr int directions = 720;
  double mean = 0;
  for (int k = 0; k < directions; ++k) {
    const double q = m + d * std::cos(2 * std::numbers::pi * k / directions);
    mean += bond_energy(1 / (1 + 2 * q)) / directions;
  }
  const double J = std::sqrt((1 + 2 * m) * (1 + 2 * m) - 4 * d * d);
  return 8 * mean + Volumetric(K, 1).energy(J);
}

double total_energy(const Simulation& simulation, const Scene& scene) {
  const Balance now = balance(simulation.snapshot(), scene);
  return now.kinetic + now.strain;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("bonds: moments are isotropic inside, at faces and on rings, and no weight is negative") {
    for (const Scene& scene : {oscillating_plate(0.01), colliding_rings()}) {
      const Layout layout = make_layout(scene);
      const Bonds bonds = bonds_of(scene, layout);
      int poor = 0;
      for (int i = 0; i < layout.size(); ++i) {
        if (layout.held[i]) continue;
        const auto m = fourth_moments(bonds, i);
        const bool good = std::abs(m[0] - 3) < 1e-9 && std::abs(m[1]) < 1e-9 && std::abs(m[2] - 1) < 1e-9 &&
                          std::abs(m[3]) < 1e-9 && std::abs(m[4] - 3) < 1e-9;
        poor += !good;
      }
      CAPTURE(scene.name);
      CAPTURE(layout.size());
      CHECK(poor <= (scene.name == "oscillating-plate" ? 2 : 0));  // the corners of the free end
      for (double w : bonds.weight) CHECK_FALSE(w < 0);
    }
  }

  TEST_CASE("bonds: the gradient of a linear field is exact at every particle") {
    const Scene scene = small_clamped_plate();
    const Layout layout = make_layout(scene);
    const Bonds bonds = bonds_of(scene, layout);
    for (int i = 0; i < layout.size(); ++i) {
      if (layout.held[i]) continue;
      double gx = 0, gy = 0;
      for (int b = bonds.begin[i]; b < bonds.begin[i + 1]; ++b) {
        const double df = 3 * bonds.X[b][0] - 7 * bonds.X[b][1];
        gx += df * bonds.gradient[b][0];
        gy += df * bonds.gradient[b][1];
      }
      CHECK(gx == Approx(3).epsilon(1e-10));
      CHECK(gy == Approx(-7).epsilon(1e-10));
    }
  }

  TEST_CASE("bonds: those into a clamp end at its face, and what is held has none") {
    const Scene scene = small_clamped_plate();
    const Layout layout = make_layout(scene);
    const Bonds bonds = bonds_of(scene, layout);
    int ends = 0;
    for (int i = 0; i < layout.size(); ++i) {
      if (layout.held[i]) CHECK(bonds.begin[i] == bonds.begin[i + 1]);
      for (int b = bonds.begin[i]; b < bonds.begin[i + 1]; ++b) {
        if (!layout.held[bonds.j[b]]) continue;
        ++ends;
        CHECK(std::abs(layout.x[i][0] + bonds.X[b][0]) < 1e-9 * scene.spacing);
      }
    }
    CHECK(ends == 3 * 5 - 2);  // of the five rows; the outermost have two
  }

  TEST_CASE("bonds: the volumes add up to the body, and integrate y² better than those of the lattice") {
    Scene scene = small_clamped_plate();
    scene.bodies.pop_back();
    scene.bodies[0].held = {};
    const Layout layout = make_layout(scene);
    const Bonds bonds = bonds_of(scene, layout);
    double exact = 0, lattice = 0, corrected = 0, V0 = 0, V = 0;
    for (int i = 0; i < layout.size(); ++i) {
      if (std::abs(layout.x[i][0] - 0.006) > 0.005) continue;  // whole columns
      const double y2 = layout.x[i][1] * layout.x[i][1], dp2 = scene.spacing * scene.spacing;
      lattice += layout.V0[i] * y2;
      corrected += bonds.volume[i] * y2;
      exact += layout.V0[i] * (y2 + dp2 / 12);
      V0 += layout.V0[i], V += bonds.volume[i];
    }
    CHECK(V == relative(V0, 1e-12));
    CHECK(std::abs(corrected - exact) < 0.4 * std::abs(lattice - exact));  // five rows: 0.3; ten: 0.15
  }
}

TEST_SUITE("term") {
  TEST_CASE("bond: the slopes are those of the energies, and rise") {
    const Volumetric U(2e7, 4e6);
    constexpr double step = 1e-6;
    const auto energy = [](double lambda) { return bond_energy(1 / (lambda * lambda)); };
    const auto slope = [](double lambda) { return lambda * bond_slope(1 / (lambda * lambda)); };
    for (double a : {0.4, 0.7, 0.95, 1.1, 1.6, 2.5}) {
      CAPTURE(a);
      CHECK((energy(a + step) - energy(a - step)) / (2 * step) == Approx(slope(a)).epsilon(1e-6));
      CHECK((U.energy(a + step) - U.energy(a - step)) / (2 * step) == Approx(U.slope(a)).epsilon(1e-6));
      CHECK(slope(a + 0.01) > slope(a));
      CHECK(U.slope(a + 0.01) > U.slope(a));
    }
    CHECK(std::abs(slope(1.0)) < 1e-16);
    CHECK(U.slope(1.0) == 0);
  }

  TEST_CASE("bond: the energy is the neo-Hookean one up to third order, in shear up to fifth, not beyond") {
    constexpr double K = 4.6;  // over G: ν = 0.4
    for (const auto& [m, d] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {0.7, 1.0}, {-0.5, 0.8}}) {
      const auto difference = [&](double e) {
        return bonded(m * e, d * e, K) - neo_hookean(m * e, d * e, K);
      };
      CAPTURE(m);
      CAPTURE(d);
      REQUIRE(std::abs(difference(0.04)) > 1e-9);
      CHECK(difference(0.04) / difference(0.02) == Approx(m == 0 ? 64 : 16).epsilon(0.15));
    }
  }

  TEST_CASE("penalty contact: none from one spacing on, and the slope of its energy") {
    CHECK(penalty_force(0.001, 0.001, 1e7, 2) == 0);
    CHECK(penalty_force(0.0011, 0.001, 1e7, 2) == 0);
    constexpr double step = 1e-8;
    for (int dim : {2, 3}) {
      const auto energy = [&](double r) { return penalty_energy(r, 0.001, 1e7, dim); };
      CHECK((energy(0.0007 - step) - energy(0.0007 + step)) / (2 * step) ==
            Approx(penalty_force(0.0007, 0.001, 1e7, dim)));
    }
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("oenog keeps linear and angular momentum to round-off, and the energy") {
    const Scene scene = colliding_rings(0.06, 0.002);
    const auto simulation = make_simulation(scene, with_method("oenog"));
    const double start = total_energy(*simulation, scene);
    double least_kinetic = start;
    for (int k = 1; k <= 24; ++k) {
      simulation->advance_to(0.0005 * k);
      const Balance now = balance(simulation->snapshot(), scene);
      least_kinetic = std::min(least_kinetic, now.kinetic);
      CHECK(std::abs(now.linear_momentum[0]) < 1e-12 * now.momentum_scale);
      CHECK(std::abs(now.linear_momentum[1]) < 1e-12 * now.momentum_scale);
      CHECK(std::abs(now.angular_momentum[2]) < 1e-12 * now.angular_scale);
      CHECK(total_energy(*simulation, scene) == Approx(start).epsilon(2e-3));
    }
    CHECK(least_kinetic < 0.3 * start);  // most of it was elastic in between
  }

  TEST_CASE("oenog keeps the angular momentum of a plate that turns fast, and the plate") {
    const Scene scene = rotating_plate(0.3);
    const auto simulation = make_simulation(scene, with_method("oenog"));
    const Balance start = balance(simulation->snapshot(), scene);
    REQUIRE(std::abs(start.angular_momentum[2]) > 0.5 * start.angular_scale);
    simulation->advance_to(scene.until);
    const Balance end = balance(simulation->snapshot(), scene);
    CHECK(end.angular_momentum[2] == Approx(start.angular_momentum[2]).epsilon(1e-11));
    CHECK(end.kinetic + end.strain == Approx(start.kinetic + start.strain).epsilon(2e-3));
  }
}

TEST_SUITE("failure") {
  TEST_CASE("rings: oenog neither fractures nor diverges at twice the speed that oas does not survive") {
    const Scene scene = colliding_rings(0.12, 0.002);
    const auto simulation = make_simulation(scene, with_method("oenog"));
    Judge judge(scene, simulation->snapshot(), simulation->support());
    for (int k = 1; k <= 24; ++k) {
      simulation->advance_to(0.0005 * k);
      judge.look(simulation->snapshot(), balance(simulation->snapshot(), scene));
    }
    CHECK(judge.verdict() == Verdict::stable);
  }
}

TEST_SUITE("convergence") {
  TEST_CASE("plate: the period of oenog comes nearer to the neo-Hookean reference with the spacing") {
    constexpr double reference = 0.25522;  // s, finite elements, neo-Hookean, v_f = 0.001
    std::array<double, 2> error{};
    for (int k = 0; k < 2; ++k) {
      Scene scene = oscillating_plate(0.001, 5 << k);
      Measure period;
      period.kind = Measure::Kind::period;
      period.probes = {scene.probes[0].name};
      scene.measures = {period};
      const auto simulation = make_simulation(scene, with_method("oenog"));
      simulation->advance_to(0.28);
      const auto result = measure(scene, simulation->series(), "neo_hookean");
      REQUIRE(result[0].value);
      error[k] = *result[0].value / reference - 1;
    }
    CHECK(error[1] < 0.003);
    CHECK(error[0] > 0);
    CHECK(std::log2(error[0] / error[1]) > 1.7);  // second order, clamp and faces included
  }
}
