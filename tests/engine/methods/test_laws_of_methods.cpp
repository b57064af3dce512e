
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/methods/bonded/closed_law.hpp"
#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/bonded/methods.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.001;
const std::array choices{Law::neo_hookean, Law::mooney_rivlin, Law::st_venant_kirchhoff, Law::linear_elastic};

Settings with_law(const std::string& method, Law law) {
  Settings settings = with_method(method);
  settings.law = std::string(law_row(law).choice);
  return settings;
}

Elasticity rubber(double share) {
  const Material rubber = ring_rubber();
  return {rubber.density, rubber.sound_speed(), rubber.bulk_modulus(), rubber.shear_modulus(), {share}};
}

template <class Visit>
void for_each_law(const Elasticity& e, const Visit& visit) {
  for (const Law law : choices)
    Materials(law, {e}).visit(0, [&](const auto& own) { visit(law_row(law), own); });
}

template <int Dim>
Mat<double, Dim> strain() {
  Mat<double, Dim> F{};
  for (int k = 0; k < Dim; ++k) F(k, k) = 1.2 - 0.17 * k;
  F(0, 1) = 0.14, F(1, 0) = -0.2;
  if constexpr (Dim == 3) F(0, 2) = 0.08, F(2, 1) = 0.1;
  return F;
}

template <int Dim>
Mat<double, Dim> pressed_strain(double share) {
  Mat<double, Dim> F = strain<Dim>();
  for (int k = 0; k < Dim; ++k) F(0, k) *= share / 1.2;
  return F;
}

/// Initial deformation gradient F plus a smooth displacement up to `off` spacings.
template <int Dim>
Scene strained_block(const Mat<double, Dim>& F, double off, double share = 0.4) {
  Scene scene;
  scene.name = "block";
  scene.dim = Dim;
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  scene.materials[0].law_parameters["cofactor_share"] = share;
  scene.bodies.resize(1);
  Body& body = scene.bodies[0];
  body.name = "block";
  body.shapes = {Box{{0, 0, 0}, {8 * dp, 6 * dp, Dim == 3 ? 5 * dp : 0}}};
  for (int a = 0; a < Dim; ++a) {
    body.displacement[a] = [=](const Point& X) {
      double u = -X[a] + off * dp * shake({X[0] + 0.3 * X[2], X[1] - 0.2 * X[2], 0}, (7 + a) * dp);
      for (int k = 0; k < Dim; ++k) u += F(a, k) * X[k];
      return u;
    };
  }
  return scene;
}

double strain_energy(const Scene& scene, const Settings& settings) {
  const Snapshot start = make_simulation(scene, settings)->snapshot();
  return std::accumulate(start.strain_energy.begin(), start.strain_energy.end(), 0.0);
}

/// From rest: v divided by the step length is the acceleration.
Snapshot after_short_step(const Scene& scene, Settings settings) {
  settings.step = 1e-12;
  return state_after(1, scene, settings);
}

/// The work is −Σ f · dx.
template <int Dim>
double work_over_energy(const std::string& method, Law law) {
  constexpr double off = 0.2, change = 1e-4;
  const Settings settings = with_law(method, law);
  const auto at = [&](double share_off) { return strained_block(strain<Dim>(), share_off); };
  const Snapshot now = after_short_step(at(off), settings);
  const Snapshot above = make_simulation(at(off + change), settings)->snapshot();
  const Snapshot below = make_simulation(at(off - change), settings)->snapshot();
  double work = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
    for (int k = 0; k < Dim; ++k)
      work += now.m[i] * now.v[Dim * i + k] / now.time * (above.x[Dim * i + k] - below.x[Dim * i + k]);
  return -work / (strain_energy(at(off + change), settings) - strain_energy(at(off - change), settings));
}

template <int Dim>
double bonded_volume(const Scene& scene) {
  const Bonds bonds =
      make_bonds(scene, make_initial_particles(scene), (Dim == 3 ? 0.9 : oenog.h_over_dp) * dp);
  double volume = 0;
  for (const double V : bonds.volume) volume += V;
  return volume;
}

double difference(const Snapshot& a, const Snapshot& b) {
  double most = 0, off = 0;
  for (std::size_t k = 0; k < a.v.size(); ++k) {
    most = std::max(most, std::abs(a.v[k] / a.time));
    off = std::max(off, std::abs(a.v[k] / a.time - b.v[k] / b.time));
  }
  return off / most;
}

template <int Dim, class L>
void check_closed(const L& law) {
  constexpr double step = 1e-6;
  for (const double pressed : {0.9, 0.45, 0.2, -0.15}) {
    const Mat<double, Dim> F = pressed_strain<Dim>(pressed), P = closed_piola(law, F);
    for (int a = 0; a < Dim; ++a) {
      for (int b = 0; b < Dim; ++b) {
        Mat<double, Dim> up = F, down = F;
        up(a, b) += step, down(a, b) -= step;
        CHECK(std::abs((closed_energy(law, up) - closed_energy(law, down)) / (2 * step) - P(a, b)) < 1e-6);
      }
    }
  }
}

}  // namespace

TEST_SUITE("term") {
  TEST_CASE(
      "oenog: the stress of each closed law is the derivative of its energy, and repulsive below J = 1/2") {
    for_each_law({1, 1, 4.6, 1, {0.4}}, [](const LawRow& row, const auto& law) {
      CAPTURE(row.choice);
      check_closed<2>(law);
      check_closed<3>(law);
      for (const double J : {0.3, 0.1, -0.1})
        CHECK(closed_piola(law, Mat<double, 2>{{{J, 0}, {0, 1}}})(0, 0) < -1);
    });
  }

  TEST_CASE("oenog: the general continuation below J = 1/2 equals ClosedNeoHookean for the neo-Hookean law") {
    const NeoHookean other{4.6, 1};
    const ClosedNeoHookean<double> own{4.6, 1};
    for (const double pressed : {0.9, 0.45, 0.2, -0.15}) {
      const Mat<double, 3> F = pressed_strain<3>(pressed), P = own.piola(F),
                           of_other = closed_piola(other, F);
      CHECK(closed_energy(other, F) == relative(own.energy(F), 1e-12));
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) CHECK(std::abs(P(a, b) - of_other(a, b)) < 1e-11);
    }
  }

  TEST_CASE("laws: under every law the forces of tl and oenog do work equal to the loss of energy") {
    for (const Law law : choices) {
      for (const std::string method : {"tl", "oenog"}) {
        CAPTURE(law_row(law).choice);
        CAPTURE(method);
        CHECK(work_over_energy<2>(method, law) == relative(1, 1e-5));
        CHECK(work_over_energy<3>(method, law) == relative(1, 1e-5));
      }
    }
  }

  TEST_CASE("laws: under a linear displacement the energy of oenog equals the energy of the law") {
    for_each_law(rubber(0.4), [](const LawRow& row, const auto& law) {
      CAPTURE(row.choice);
      const auto check = [&]<int Dim>() {
        const Mat<double, Dim> F = strain<Dim>();
        const Scene scene = strained_block(F, 0);
        const double W = law.energy(F, determinant(F));
        CHECK(strain_energy(scene, with_law("oenog", row.law)) ==
              relative(bonded_volume<Dim>(scene) * W, 1e-10));
      };
      check.template operator()<2>();
      check.template operator()<3>();
    });
  }

  TEST_CASE("laws: mixed methods without dissipation and projection start with the forces of tl") {
    for (const Law law : choices) {
      CAPTURE(law_row(law).choice);
      const auto first = [&]<int Dim>(const std::string& method) {
        Settings settings = with_law(method, law);
        if (method != "tl") settings.constants["projection"] = 0;
        for (const MethodConstant& constant : find_method(method)->constants)
          if (constant.name.starts_with("eps")) settings.constants[std::string(constant.name)] = 0;
        return after_short_step(strained_block(strain<Dim>(), 0.2), settings);
      };
      const Snapshot tl = first.operator()<2>("tl"), tl_3d = first.operator()<3>("tl");
      for (const std::string method : {"pf", "pf-jst", "pfj-jst", "pfhj-jst"}) {
        CAPTURE(method);
        if (!reason_against_law(*find_method(method), law_row(law).choice).empty()) continue;
        CHECK(difference(tl, first.operator()<2>(method)) < 1e-6);
        CHECK(difference(tl_3d, first.operator()<3>(method)) < 1e-6);
      }
    }
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("laws: objective laws conserve linear and angular momentum") {
    const auto drift = [](Scene scene, const std::string& method, Law law) {
      scene.bodies[0].velocity[0] = [](const Point& X) { return 300 * X[1] + 2 * shake(X, 5 * dp); };
      scene.bodies[0].velocity[1] = [](const Point& X) { return -200 * X[0]; };
      const auto simulation = make_simulation(scene, with_law(method, law));
      const Balance start = balance(simulation->snapshot(), scene);
      make_steps(*simulation, 60);
      const Balance now = balance(simulation->snapshot(), scene);
      double linear = 0, angular = 0;
      for (int k = 0; k < 3; ++k) {
        linear = std::max(linear, std::abs(now.linear_momentum[k] - start.linear_momentum[k]));
        angular = std::max(angular, std::abs(now.angular_momentum[k] - start.angular_momentum[k]));
      }
      CHECK(linear < 1e-12 * now.momentum_scale);
      return angular / now.angular_scale;
    };
    const Scene plane = strained_block(strain<2>(), 0.2), space = strained_block(strain<3>(), 0.2);
    for (const Law law : {Law::mooney_rivlin, Law::st_venant_kirchhoff}) {
      for (const std::string method : {"tl", "oenog", "pf-jst"}) {
        CAPTURE(law_row(law).choice);
        CAPTURE(method);
        CHECK(drift(plane, method, law) < 1e-12);
        CHECK(drift(space, method, law) < 1e-12);
      }
    }
    CHECK(drift(space, "pfhj-jst", Law::mooney_rivlin) < 1e-12);
    CHECK(drift(plane, "oenog", Law::linear_elastic) > 1e-4);
  }
  TEST_CASE("laws: an unused material does not shorten the steps") {
    for (const char* method : {"enog", "d-ulsph-r-tic", "tl", "pf-jst", "oenog"}) {
      CAPTURE(method);
      Scene scene = strained_block(Mat<double, 2>{{{1, 0}, {0, 1}}}, 0);
      for (Expression& component : scene.bodies[0].displacement) component = {};
      const double alone = state_after(1, scene, with_method(method)).time;
      Material steel = scene.materials[0];
      steel.name = "steel", steel.youngs_modulus *= 1e4;
      scene.materials.push_back(steel);
      scene.bodies[0].material = 1;
      scene.bodies[0].parts = {{0, constant(1)}};
      CHECK(state_after(1, scene, with_method(method)).time == alone);
    }
  }
}

}  // namespace of_this_file
