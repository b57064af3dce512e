// The methods in 3D against transcriptions of their papers.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/methods/oenog.hpp"
#include "engine/scene/initial_particles.hpp"
#include "tests/engine/families/naive_lee2016.hpp"
#include "tests/engine/families/naive_oenog.hpp"
#include "tests/engine/families/naive_total_lagrangian.hpp"
#include "tests/engine/families/naive_zhang2024.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

using namespace taut;
using namespace taut::test;

namespace {

constexpr int steps = 40;
constexpr double agreement = 1e-10;  // of the greatest magnitude of each field

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

void check_ulsph(const Scene& scene, const std::string& name, naive::Method method, Stepping stepping) {
  CAPTURE(name);
  const Material& material = scene.materials[0];
  naive::Run<3> run(method, stepping == Stepping::dual, scene.spacing, material.density,
                    material.sound_speed(), material.shear_modulus());
  const InitialParticles initial = make_initial_particles(scene);
  for (int i = 0; i < initial.size(); ++i) {
    naive::Run<3>::Particle a;
    a.x = initial.x[i], a.v = initial.v[i];
    a.m = material.density * initial.V0[i];
    a.body = initial.body[i];
    a.held = initial.held[i];
    run.particles.push_back(a);
  }
  run.start();
  for (int k = 0; k < steps; ++k) run.step();
  run.finish();
  CHECK(run.contacts > 100);
  if (stepping == Stepping::single)
    CHECK(run.rebuilds == steps);
  else
    CHECK((run.rebuilds > 4 && run.rebuilds < steps / 2));

  const Snapshot now = state_after(steps, scene, with_method(name, stepping));
  CHECK(now.time == relative(run.time, 1e-12));
  std::vector<double> x, v, rho, p, s;
  Point greatest_shear{};
  for (const auto& a : run.particles) {
    x.insert(x.end(), a.x.begin(), a.x.end());
    v.insert(v.end(), a.v.begin(), a.v.end());
    rho.push_back(a.rho);
    p.push_back(a.p);
    s.insert(s.end(), {a.s[0][0], a.s[0][1], a.s[0][2], a.s[1][1], a.s[1][2], a.s[2][2]});
    const double in_plane[] = {a.s[0][1], a.s[0][2], a.s[1][2]};
    for (int k = 0; k < 3; ++k) greatest_shear[k] = std::max(greatest_shear[k], std::abs(in_plane[k]));
  }
  CHECK(*std::ranges::min_element(greatest_shear) > 1e4);  // Pa: strained by more than 1/1000 in each plane
  check_field("x", now.x, x);
  check_field("v", now.v, v);
  check_field("rho", now.rho, rho);
  check_field("p", now.p, p);
  check_field("s", now.s, s);
}

void check_ulsph_methods(const Scene& scene, Stepping stepping) {
  check_ulsph(scene, "og", naive::Method::og, stepping);
  check_ulsph(scene, "oas", naive::Method::oas, stepping);
  check_ulsph(scene, "enog", naive::Method::enog, stepping);
  check_ulsph(scene, "enog-nonconservative", naive::Method::enog_nonconservative, stepping);
}

void check_total_lagrangian(const Scene& scene, const std::string& name, naive_reference::Method method) {
  CAPTURE(name);
  const MethodInfo& info = *find_method(name);
  const Material& material = scene.materials[0];
  naive_reference::Run<3> run{method,
                              scene.spacing,
                              info.formulation.h_over_dp * scene.spacing,
                              info.cfl,
                              material.density,
                              material.bulk_modulus(),
                              material.shear_modulus(),
                              info.formulation.contact_stiffness,
                              {}};
  const InitialParticles initial = make_initial_particles(scene);
  for (int i = 0; i < initial.size(); ++i) {
    naive_reference::Particle<3> a;
    for (int k = 0; k < 3; ++k) a.X[k] = a.x[k] = initial.x[i][k], a.v[k] = initial.v[i][k];
    a.V = initial.V0[i];
    a.m = material.density * a.V;
    a.body = initial.body[i];
    a.held = initial.held[i];
    run.particles.push_back(a);
  }
  run.start();
  for (int k = 0; k < steps; ++k) run.step();
  run.deform();
  CHECK(run.contacts > 20);

  const Snapshot now = state_after(steps, scene, with_method(name));
  CHECK(now.time == relative(run.time, 1e-12));
  std::vector<double> x, v, rho, sigma, engine_sigma;
  double most_strained = 0, most_turned = 0;
  for (std::size_t n = 0; n < run.particles.size(); ++n) {
    const auto& a = run.particles[n];
    x.insert(x.end(), a.x.begin(), a.x.end());
    v.insert(v.end(), a.v.begin(), a.v.end());
    const double J = a.F.determinant();
    most_strained = std::max(most_strained, std::abs(J - 1));
    most_turned = std::max(most_turned, std::abs(a.F(2, 1) - a.F(1, 2)));
    rho.push_back(run.rho0 / J);
    const naive_reference::Matrix<3> cauchy = a.P * a.F.transpose() / J;
    sigma.insert(sigma.end(),
                 {cauchy(0, 0), cauchy(0, 1), cauchy(0, 2), cauchy(1, 1), cauchy(1, 2), cauchy(2, 2)});
    const StressTensor t = now.stress(n), s = now.deviator(n);
    engine_sigma.insert(engine_sigma.end(), {t.xx, t.xy, t.xz, t.yy, t.yz, t.zz});
    CHECK(std::abs(s.xx + s.yy + s.zz) < 1e-9 * material.youngs_modulus);
  }
  CHECK(most_strained > 0.01);
  CHECK(most_turned > 0.01);
  check_field("x", now.x, x);
  check_field("v", now.v, v);
  check_field("rho", now.rho, rho);
  check_field("stress", engine_sigma, sigma);
}

/// Every dissipation acts, at a step of its own.
void check_mixed(const Scene& scene, const std::string& name, double projection) {
  CAPTURE(name);
  const Material& material = scene.materials[0];
  constexpr double h_over_dp = 0.87;  // the default in 3D
  const bool jst = name != "pf", with_J = name.starts_with("pfj") || name == "pfhj-jst";
  naive_lee::Run<3> run{.jst = jst,
                        .with_J = with_J,
                        .with_H = name == "pfhj-jst",
                        .dp = scene.spacing,
                        .h = h_over_dp * scene.spacing,
                        .cfl = 0,
                        .rho0 = material.density,
                        .K = material.bulk_modulus(),
                        .G = material.shear_modulus(),
                        .contact_stiffness = 2,
                        .eps_p2 = 0.03,
                        .eps_p4 = 0.1,
                        .eps_J2 = 0.02,
                        .eps_J4 = 0.01,
                        .projection = projection != 0,
                        .adjoint = true,
                        .particles = {}};
  run.dt = 0.2 * scene.spacing / run.wave_speed();
  const InitialParticles initial = make_initial_particles(scene);
  for (int i = 0; i < initial.size(); ++i) {
    naive_lee::Particle<3> a;
    for (int k = 0; k < 3; ++k) a.X[k] = a.x[k] = initial.x[i][k], a.p[k] = run.rho0 * initial.v[i][k];
    a.V = initial.V0[i];
    a.body = initial.body[i];
    a.held = initial.held[i];
    run.particles.push_back(a);
  }
  run.start();
  for (int k = 0; k < steps; ++k) run.step();
  CHECK(run.contacts > 20);
  CHECK(run.corners == 8);

  Settings settings = with_method(name);
  settings.step = run.dt;
  settings.constants = {{"projection", projection}};
  if (jst) settings.constants.insert({{"eps_v2", run.eps_p2}, {"eps_v4", run.eps_p4}});
  if (with_J) settings.constants.insert({{"eps_J2", run.eps_J2}, {"eps_J4", run.eps_J4}});
  const Snapshot now = state_after(steps, scene, settings);
  std::vector<double> x, v, rho;
  double drift_J = 0, drift_H = 0;
  for (const naive_lee::Particle<3>& a : run.particles) {
    x.insert(x.end(), a.x.begin(), a.x.end());
    for (int k = 0; k < 3; ++k) v.push_back(a.p[k] / run.rho0);
    const double j = a.F.determinant();
    drift_J = std::max(drift_J, std::abs(a.J - j));
    drift_H = std::max(drift_H, (a.H - j * a.F.inverse().transpose()).norm());
    rho.push_back(run.rho0 / (with_J ? a.J : j));
  }
  // so that they are no other names of those of F
  CHECK((!with_J || drift_J > 1e-4));
  CHECK(drift_H > 1e-6);
  check_field("x", now.x, x);
  check_field("v", now.v, v);
  check_field("rho", now.rho, rho);
}

void check_oenog(const Scene& scene, bool meets) {
  CAPTURE(scene.name);
  constexpr double damping = 0.01, h_over_dp = 0.9;  // the defaults in 3D
  NaiveOenogIn<3> naive(scene, h_over_dp);
  for (int k = 0; k < steps; ++k) naive.step(oenog.cfl, damping);
  CHECK((naive.contacts > 20) == meets);
  const Snapshot now = state_after(steps, scene, with_method("oenog"));
  std::vector<double> x, v;
  double strain = 0, moved = 0;
  for (int i = 0; i < naive.size(); ++i) {
    x.insert(x.end(), naive.x[i].begin(), naive.x[i].end());
    v.insert(v.end(), naive.v[i].begin(), naive.v[i].end());
    for (int k = 0; k < 3; ++k) moved = std::max(moved, std::abs(now.x[3 * i + k] - now.x0[3 * i + k]));
  }
  for (const double e : now.strain_energy) strain += e;
  check_field("x", now.x, x);
  check_field("v", now.v, v);
  CHECK(moved > 0.3 * scene.spacing);
  CHECK(strain == relative(naive.energy(naive.x), 1e-9));
}

/// The right half of a softer, lighter material.
Scene clamped_block_of_two_materials() {
  Scene scene = small_clamped_block();
  scene.bodies.pop_back();
  scene.materials.push_back({"soft", /*ρ0*/ 900, /*E*/ 4e6, /*ν*/ 0.3});
  scene.bodies[0].parts = {{1, [](const Point& x) { return x[0] > 0.003 ? 1.0 : 0.0; }}};
  return scene;
}

}  // namespace

TEST_SUITE("reference") {
  TEST_CASE("naive: in 3D a block and a ball that collide, dual and single stepping") {
    check_ulsph_methods(small_solid_collision(), Stepping::dual);
    check_ulsph_methods(small_solid_collision(), Stepping::single);
  }
  TEST_CASE("naive: in 3D a clamped block hit on its clamp, dual stepping") {
    check_ulsph_methods(small_clamped_block(), Stepping::dual);
  }
  TEST_CASE("total Lagrangian: in 3D a block and a ball that collide, and a clamped block hit on its clamp") {
    for (const Scene& scene : {small_solid_collision(), small_clamped_block()}) {
      CAPTURE(scene.name);
      check_total_lagrangian(scene, "tl", naive_reference::Method::tl);
      check_total_lagrangian(scene, "icb", naive_reference::Method::icb);
    }
  }
  TEST_CASE("mixed: in 3D a block and a ball that collide, and a clamped block hit on its clamp") {
    for (const std::string name : {"pf", "pf-jst", "pfj-jst", "pfhj-jst"}) {
      check_mixed(small_solid_collision(), name, 1);
      check_mixed(small_clamped_block(), name, 0);
    }
  }
  TEST_CASE("oenog: in 3D 40 steps are those of the formulas, with a collision, a clamp and two materials") {
    check_oenog(small_solid_collision(), true);
    check_oenog(small_clamped_block(), true);
    check_oenog(clamped_block_of_two_materials(), false);
  }
}
