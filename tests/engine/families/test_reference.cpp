#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/scene/initial_particles.hpp"
#include "engine/simulation.hpp"
#include "tests/engine/families/naive_zhang2024.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scenes.hpp"

using namespace taut;
using namespace taut::test;
using naive::Method;

namespace {

constexpr int steps = 48;
constexpr double agreement = 1e-10;  // of the greatest magnitude of each field

const std::pair<std::string, Method> named_methods[] = {
    {"og", Method::og},
    {"oas", Method::oas},
    {"enog", Method::enog},
    {"enog-nonconservative", Method::enog_nonconservative},
};

naive::Run<2> naive_run(const Scene& scene, Method method, Stepping stepping, double pressure_diffusion = 0) {
  const Material& material = scene.materials[0];
  naive::Run<2> run(method, stepping == Stepping::dual, scene.spacing, material.density,
                    material.sound_speed(), material.shear_modulus());
  const InitialParticles initial = make_initial_particles(scene);
  for (int i = 0; i < initial.size(); ++i) {
    naive::Run<2>::Particle a;
    for (int k = 0; k < 2; ++k) a.x[k] = initial.x[i][k], a.v[k] = initial.v[i][k];
    a.m = material.density * initial.V0[i];
    a.body = initial.body[i];
    a.held = initial.held[i];
    run.particles.push_back(a);
  }
  run.pressure_diffusion = pressure_diffusion;
  run.start();
  for (int k = 0; k < steps; ++k) run.step();
  run.finish();
  return run;
}

/// The engine's state after the same number of steps.
Snapshot engine_run(const Scene& scene, const std::string& method, Stepping stepping,
                    double pressure_diffusion = 0) {
  Settings settings;
  settings.method = method;
  settings.stepping = stepping;
  settings.threads = 1;
  settings.constants["pressure_diffusion"] = pressure_diffusion;
  const auto simulation = make_simulation(scene, settings);
  while (simulation->steps() < steps)
    simulation->advance_to(std::nextafter(simulation->time(), std::numeric_limits<double>::max()));
  return simulation->snapshot();
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

void check_agreement(const Snapshot& engine, const naive::Run<2>& run, double c0) {
  std::vector<double> x, v, rho, p, s;
  double fastest = 0, greatest_stress = 0;
  for (const naive::Run<2>::Particle& a : run.particles) {
    x.insert(x.end(), a.x.begin(), a.x.end());
    v.insert(v.end(), a.v.begin(), a.v.end());
    rho.push_back(a.rho);
    p.push_back(a.p);
    s.insert(s.end(), {a.s[0][0], a.s[0][1], a.s[1][1], 0});
    fastest = std::max(fastest, std::hypot(a.v[0], a.v[1]));
    greatest_stress = std::max(greatest_stress, std::abs(a.s[0][1]));
  }
  CHECK(engine.time == relative(run.time, 1e-12));
  CHECK(fastest > 0.05 * c0);
  CHECK(greatest_stress > 1e4);  // Pa: strained by more than 1/1000
  check_field("x", engine.x, x);
  check_field("v", engine.v, v);
  check_field("rho", engine.rho, rho);
  check_field("p", engine.p, p);
  check_field("s", engine.s, s);
}

void check_all_methods(const Scene& scene, Stepping stepping) {
  for (const auto& [name, method] : named_methods) {
    CAPTURE(name);
    const naive::Run<2> run = naive_run(scene, method, stepping);
    CHECK(run.contacts > 100);
    if (stepping == Stepping::single)
      CHECK(run.rebuilds == steps);
    else
      CHECK((run.rebuilds > 4 && run.rebuilds < steps / 2));
    check_agreement(engine_run(scene, name, stepping), run, scene.materials[0].sound_speed());
  }
}

}  // namespace

TEST_SUITE("reference") {
  TEST_CASE("naive: a ring and a disc that collide, dual stepping") {
    check_all_methods(small_collision(), Stepping::dual);
  }
  TEST_CASE("naive: a ring and a disc that collide, single stepping") {
    check_all_methods(small_collision(), Stepping::single);
  }
  TEST_CASE("naive: a clamped plate hit on its clamp, dual stepping") {
    check_all_methods(small_clamped_plate(), Stepping::dual);
  }
  TEST_CASE("naive: a clamped plate hit on its clamp, single stepping") {
    check_all_methods(small_clamped_plate(), Stepping::single);
  }
  TEST_CASE("naive: with the full U*, that diffuses pressure") {
    const Scene scene = small_collision();
    const double c0 = scene.materials[0].sound_speed();
    const naive::Run<2> without = naive_run(scene, Method::enog, Stepping::dual);
    const naive::Run<2> run = naive_run(scene, Method::enog, Stepping::dual, 1);
    CHECK(std::abs(run.particles[0].p - without.particles[0].p) > 1e-3 * std::abs(run.particles[0].p));
    check_agreement(engine_run(scene, "enog", Stepping::dual, 1), run, c0);
  }
}
