// Total-Lagrangian methods against a transcription of their papers.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/scene/initial_particles.hpp"
#include "tests/engine/families/naive_lee2016.hpp"
#include "tests/engine/families/naive_total_lagrangian.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

using namespace taut;
using namespace taut::test;
using naive_reference::Method;

namespace {

constexpr int steps = 60;
constexpr int mixed_steps = 45;
constexpr double agreement = 1e-10;  // of the greatest magnitude of each field

struct Case {
  std::string name;
  Method method;
  std::string law = "";
};

double constant_of(const MethodInfo& method, std::string_view name) {
  for (const MethodConstant& c : method.constants)
    if (c.name == name) return c.value;
  return 0;
}

naive_reference::Run<2> naive_run(const Scene& scene, const Case& test) {
  const MethodInfo& info = *find_method(test.name);
  const Material& material = scene.materials[0];
  naive_reference::Run<2> run{test.method,
                              scene.spacing,
                              constant_of(info, "h") * scene.spacing,
                              info.cfl,
                              material.density,
                              material.bulk_modulus(),
                              material.shear_modulus(),
                              constant_of(info, "contact_stiffness"),
                              {}};
  const InitialParticles initial = make_initial_particles(scene);
  for (int i = 0; i < initial.size(); ++i) {
    naive_reference::Particle<2> a;
    for (int k = 0; k < 2; ++k) a.X[k] = a.x[k] = initial.x[i][k], a.v[k] = initial.v[i][k];
    a.V = initial.V0[i];
    a.m = material.density * a.V;
    a.body = initial.body[i];
    a.held = initial.held[i];
    run.particles.push_back(a);
  }
  run.start();
  for (int k = 0; k < steps; ++k) run.step();
  run.deform();
  return run;
}

void check_field(const std::string& field, const std::vector<double>& engine,
                 const std::vector<double>& expected) {
  CAPTURE(field);
  REQUIRE(engine.size() == expected.size());
  double greatest = 0, difference = 0;
  for (std::size_t k = 0; k < engine.size(); ++k) {
    greatest = std::max(greatest, std::abs(expected[k]));
    difference = std::max(difference, std::abs(engine[k] - expected[k]));
  }
  CHECK(greatest > 0);
  CHECK(difference <= agreement * greatest);
}

void check_method(const Scene& scene, const Case& test) {
  CAPTURE(test.name);
  CAPTURE(test.law);
  const naive_reference::Run<2> run = naive_run(scene, test);
  Settings settings = with_method(test.name);
  settings.law = test.law;
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

const Case cases[] = {{"tl", Method::tl},
                      {"icb", Method::icb},
                      {"tl-small-strain", Method::small_strain},
                      {"tl", Method::tl, "neo-hookean"},
                      {"tl", Method::tl_st_venant_kirchhoff, "st-venant-kirchhoff"},
                      {"tl", Method::tl_linear, "linear"}};

naive_lee::Run<2> naive_mixed_run(const Scene& scene, const std::string& name, const Settings& settings) {
  const MethodInfo& info = *find_method(name);
  const Material& material = scene.materials[0];
  const auto constant = [&](const char* key) {
    const auto set = settings.constants.find(key);
    return set == settings.constants.end() ? constant_of(info, key) : set->second;
  };
  naive_lee::Run<2> run{name != "pf",
                        name == "pfj-jst",
                        false,
                        scene.spacing,
                        constant("h") * scene.spacing,
                        info.cfl,
                        material.density,
                        material.bulk_modulus(),
                        material.shear_modulus(),
                        constant("contact_stiffness"),
                        constant("eps_v2"),
                        constant("eps_v4"),
                        constant("eps_J2"),
                        constant("eps_J4"),
                        constant("projection") != 0,
                        constant("adjoint") != 0,
                        {}};
  const InitialParticles initial = make_initial_particles(scene);
  for (int i = 0; i < initial.size(); ++i) {
    naive_lee::Particle<2> a;
    a.X = a.x = {initial.x[i][0], initial.x[i][1]};
    a.p = material.density * naive_lee::Vec<2>(initial.v[i][0], initial.v[i][1]);
    a.V = initial.V0[i];
    a.body = initial.body[i];
    a.held = initial.held[i];
    run.particles.push_back(a);
  }
  run.start();
  for (int k = 0; k < mixed_steps; ++k) run.step();
  return run;
}

void check_mixed(const Scene& scene, const std::string& name, const Settings& settings) {
  CAPTURE(name);
  const naive_lee::Run<2> run = naive_mixed_run(scene, name, settings);
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
  TEST_CASE("total Lagrangian: a ring and a disc that collide") {
    for (const Case& test : cases) check_method(small_collision(), test);
  }
  TEST_CASE("total Lagrangian: a clamped plate hit on its clamp") {
    for (const Case& test : cases) check_method(small_clamped_plate(), test);
  }
  TEST_CASE("mixed: a ring and a disc that collide") {
    for (const std::string name : {"pf", "pf-jst", "pfj-jst"})
      check_mixed(small_collision(), name, with_method(name));
  }
  TEST_CASE("mixed: a clamped plate hit on its clamp, without projection, with all dissipation") {
    Settings settings = with_method("pfj-jst");
    settings.constants = {
        {"projection", 0}, {"eps_v2", 0.03}, {"eps_J2", 0.02}, {"eps_J4", 0.01}, {"adjoint", 0}};
    check_mixed(small_clamped_plate(), "pfj-jst", settings);
  }
}
