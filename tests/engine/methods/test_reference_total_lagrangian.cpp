
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/engine/methods/naive_runs.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr int steps = 60;
constexpr int mixed_steps = 60;

void check_method(const Scene& given, const std::string& name, const std::string& law) {
  const Scene scene = with_contact_of_particles(given, name);
  CAPTURE(name);
  CAPTURE(law);
  Settings settings = with_method(name);
  settings.law = law;
  naive_reference::Run<2> run = after_steps(naive_total_lagrangian<2>(scene, settings), steps);
  run.deform();
  const Snapshot now = state_after(steps, scene, settings);
  CHECK(run.contacts > 100);
  CHECK(now.time == relative(run.time, 1e-12));
  std::vector<double> x, v, rho, sigma, engine_sigma;
  double most_strained = 0;
  for (std::size_t n = 0; n < run.particles.size(); ++n) {
    const naive_reference::Particle<2>& a = run.particles[n];
    x.insert(x.end(), a.x.begin(), a.x.end());
    v.insert(v.end(), a.v.begin(), a.v.end());
    const double J = a.F.determinant();
    most_strained = std::max(most_strained, std::abs(J - 1));
    rho.push_back(run.rho0 / J);
    for (int p = 0; p < 2; ++p)
      for (int q = p; q < 2; ++q) sigma.push_back(run.linear() ? a.P(p, q) : a.P.row(p).dot(a.F.row(q)) / J);
    engine_sigma.push_back(now.s[4 * n] - now.p[n]);
    engine_sigma.push_back(now.s[4 * n + 1]);
    engine_sigma.push_back(now.s[4 * n + 2] - now.p[n]);
    CHECK(std::abs(now.s[4 * n] + now.s[4 * n + 2] + now.s[4 * n + 3]) <
          1e-9 * scene.materials[0].youngs_modulus);
  }
  CHECK(most_strained > 0.01);
  check_field("x", now.x, x);
  check_field("v", now.v, v);
  check_field("rho", now.rho, rho);
  check_field("stress", engine_sigma, sigma);
}

void check_methods(const Scene& scene) {
  check_method(scene, "tl", "");
  check_method(scene, "icb", "");
  check_method(scene, "tl-small-strain", "");
  check_method(scene, "tl-hg", "");
  check_method(scene, "tl-enog", "");
  for (const std::string law : {"neo-hookean", "st-venant-kirchhoff", "linear"})
    check_method(scene, "tl", law);
}

void check_mixed(const Scene& given, const std::string& name, const Settings& settings) {
  const Scene scene = with_contact_of_particles(given, name);
  CAPTURE(name);
  naive_lee::Run<2> run = after_steps(naive_mixed<2>(scene, settings), mixed_steps);
  const Snapshot now = state_after(mixed_steps, scene, settings);
  CHECK(run.contacts > 100);
  CHECK(now.time == relative(run.time, 1e-12));
  std::vector<double> x, v, rho, sigma, engine_sigma;
  double drifted = 0;
  for (std::size_t n = 0; n < run.particles.size(); ++n) {
    const naive_lee::Particle<2>& a = run.particles[n];
    x.insert(x.end(), a.x.begin(), a.x.end());
    for (int k = 0; k < 2; ++k) v.push_back(a.p[k] / run.rho0);
    const double J = run.with_J ? a.J : a.F.determinant();
    drifted = std::max(drifted, std::abs(J - a.F.determinant()));
    rho.push_back(run.rho0 / J);
    const naive_lee::Mat<2> s = run.stress(a) * a.F.transpose() / a.F.determinant();
    sigma.insert(sigma.end(), {s(0, 0), s(0, 1), s(1, 1)});
    engine_sigma.insert(engine_sigma.end(),
                        {now.s[4 * n] - now.p[n], now.s[4 * n + 1], now.s[4 * n + 2] - now.p[n]});
  }
  CHECK((drifted > 1e-5) == run.with_J);
  check_field("x", now.x, x);
  check_field("v", now.v, v);
  check_field("rho", now.rho, rho);
  check_field("stress", engine_sigma, sigma);
}

}  // namespace

TEST_SUITE("reference") {
  TEST_CASE("total Lagrangian: a colliding ring and disc follow the transcription") {
    check_methods(small_collision());
  }
  TEST_CASE("total Lagrangian: a plate hit on its clamp follows the transcription") {
    check_methods(small_clamped_plate());
  }
  TEST_CASE("mixed: a colliding ring and disc follow the transcription") {
    for (const std::string name : {"pf", "pf-jst", "pfj-jst"})
      check_mixed(small_collision(), name, with_method(name));
  }
  TEST_CASE("mixed: variants with one-sided forces or J in the deviator follow the transcription") {
    for (const std::string name : {"pf", "pfj-jst"}) {
      for (const Scene& scene : {small_collision(), small_clamped_plate()}) {
        Settings settings = with_method(name);
        settings.constants = {{"internal_force", 1}, {"projection", name == "pf" ? 0 : 1}};
        check_mixed(scene, name, settings);
        if (name == "pf") continue;
        settings.constants = {{"deviator_ratio", 1}};
        check_mixed(scene, name, settings);
      }
    }
  }
  TEST_CASE(
      "mixed: a plate hit on its clamp follows the transcription without projection, with all dissipation") {
    Settings settings = with_method("pfj-jst");
    settings.constants = {
        {"projection", 0}, {"eps_v2", 0.03}, {"eps_J2", 0.02}, {"eps_J4", 0.01}, {"adjoint", 0}};
    check_mixed(small_clamped_plate(), "pfj-jst", settings);
  }
}

}  // namespace of_this_file
