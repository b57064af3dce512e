
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/methods/bonded/methods.hpp"
#include "tests/engine/methods/bonded/naive_oenog.hpp"
#include "tests/engine/methods/naive_runs.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr int steps = 40;
/// In 3D the pair cache of `ul_split` has single precision.
constexpr double single_precision = 3e-7;

void check_ulsph(const Scene& scene, const std::string& name, Stepping stepping) {
  CAPTURE(name);
  naive::Run<3> run = after_steps(naive_split<3>(scene, with_method(name, stepping)), steps);
  run.finish();
  CHECK(run.contacts > 100);
  if (stepping == Stepping::single)
    CHECK(run.rebuilds == steps);
  else
    CHECK((run.rebuilds > 4 && run.rebuilds < steps / 2));

  const Snapshot now = state_after(steps, scene, with_method(name, stepping));
  CHECK(now.time == relative(run.time, single_precision));
  std::vector<double> x, v, rho, p, s;
  Point greatest_shear{};
  for (const auto& a : run.particles) {
    x.insert(x.end(), a.x.begin(), a.x.end());
    v.insert(v.end(), a.v.begin(), a.v.end());
    rho.push_back(a.rho);
    p.push_back(a.p);
    s.insert(s.end(), {a.s[0][0], a.s[0][1], a.s[0][2], a.s[1][1], a.s[1][2], a.s[2][2]});
    const double shear[] = {a.s[0][1], a.s[0][2], a.s[1][2]};
    for (int k = 0; k < 3; ++k) greatest_shear[k] = std::max(greatest_shear[k], std::abs(shear[k]));
  }
  CHECK(*std::ranges::min_element(greatest_shear) > 1e4);
  check_field("x", now.x, x, single_precision);
  check_field("v", now.v, v, single_precision);
  check_field("rho", now.rho, rho, single_precision);
  check_field("p", now.p, p, single_precision);
  check_field("s", now.s, s, single_precision);
}

void check_ulsph_methods(const Scene& scene, Stepping stepping) {
  for (const std::string name : {"og", "oas", "enog", "enog-nonconservative", "gnog", "gnog-amc"})
    check_ulsph(scene, name, stepping);
}

void check_total_lagrangian(const Scene& given, const std::string& name) {
  const Scene scene = with_contact_of_particles(given, name);
  CAPTURE(name);
  naive_reference::Run<3> run = after_steps(naive_total_lagrangian<3>(scene, with_method(name)), steps);
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
    const naive_reference::Matrix<3> cauchy =
        run.linear() ? a.P : naive_reference::Matrix<3>(a.P * a.F.transpose() / J);
    sigma.insert(sigma.end(),
                 {cauchy(0, 0), cauchy(0, 1), cauchy(0, 2), cauchy(1, 1), cauchy(1, 2), cauchy(2, 2)});
    const StressTensor t = now.stress(n), s = now.deviator(n);
    engine_sigma.insert(engine_sigma.end(), {t.xx, t.xy, t.xz, t.yy, t.yz, t.zz});
    CHECK(std::abs(s.xx + s.yy + s.zz) < 1e-9 * scene.materials[0].youngs_modulus);
  }
  CHECK(most_strained > 0.01);
  CHECK(most_turned > 0.01);
  check_field("x", now.x, x);
  check_field("v", now.v, v);
  check_field("rho", now.rho, rho);
  check_field("stress", engine_sigma, sigma);
}

void check_mixed(const Scene& given, const std::string& name, double projection,
                 const char* printed = nullptr) {
  const Scene scene = with_contact_of_particles(given, name);
  CAPTURE(name);
  const Material& material = scene.materials[0];
  Settings settings = with_method(name);
  settings.step = 0.2 * scene.spacing /
                  std::sqrt((material.bulk_modulus() + 4 * material.shear_modulus() / 3) / material.density);
  settings.constants = {{"projection", projection}};
  if (printed) settings.constants[printed] = 1;
  if (name != "pf") settings.constants.insert({{"eps_v2", 0.03}, {"eps_v4", 0.1}});
  if (name == "pfj-jst" || name == "pfhj-jst")
    settings.constants.insert({{"eps_J2", 0.02}, {"eps_J4", 0.01}});
  const naive_lee::Run<3> run = after_steps(naive_mixed<3>(scene, settings), steps);
  CHECK(run.contacts > 20);
  CHECK(run.corners == 8);

  const Snapshot now = state_after(steps, scene, settings);
  std::vector<double> x, v, rho;
  double drift_J = 0, drift_H = 0;
  for (const naive_lee::Particle<3>& a : run.particles) {
    x.insert(x.end(), a.x.begin(), a.x.end());
    for (int k = 0; k < 3; ++k) v.push_back(a.p[k] / run.rho0);
    const double j = a.F.determinant();
    drift_J = std::max(drift_J, std::abs(a.J - j));
    drift_H = std::max(drift_H, (a.H - j * a.F.inverse().transpose()).norm());
    rho.push_back(run.rho0 / (run.with_J ? a.J : j));
  }
  CHECK((!run.with_J || drift_J > 1e-4));
  CHECK(drift_H > 1e-6);
  check_field("x", now.x, x);
  check_field("v", now.v, v);
  check_field("rho", now.rho, rho);
}

void check_oenog(Scene scene, bool meets) {
  CAPTURE(scene.name);
  scene.contact = ContactLaw::penalty;
  constexpr double damping = 0.01, h_over_dp = 0.9;
  NaiveOenogIn<3> naive(scene, h_over_dp);
  Settings settings = with_method("oenog");
  settings.step = 0.4 * scene.spacing / scene.materials[0].sound_speed();
  for (int k = 0; k < steps; ++k) naive.step(oenog.cfl, damping, settings.step);
  CHECK((naive.contacts > 20) == meets);
  const Snapshot now = state_after(steps, scene, settings);
  double strain = 0, moved = 0;
  for (std::size_t k = 0; k < now.x.size(); ++k) moved = std::max(moved, std::abs(now.x[k] - now.x0[k]));
  for (const double e : now.strain_energy) strain += e;
  check_field("x", now.x, flat(naive.x));
  check_field("v", now.v, flat(naive.v));
  check_field("force by hand", flat(naive.force_by_hand(naive.x)), flat(naive.force(naive.x)));
  CHECK(moved > 0.3 * scene.spacing);
  CHECK(strain == relative(naive.energy(naive.x), 1e-9));
}

Scene clamped_block_of_two_materials() {
  Scene scene = small_clamped_block();
  scene.bodies.pop_back();
  scene.materials.push_back({"soft", /*ρ0*/ 900, /*E*/ 4e6, /*ν*/ 0.3});
  scene.bodies[0].parts = {{1, [](const Point& x) { return x[0] > 0.003 ? 1.0 : 0.0; }}};
  return scene;
}

}  // namespace

TEST_SUITE("reference") {
  TEST_CASE("naive: in 3D a colliding block and ball follow the transcription with both steppings") {
    check_ulsph_methods(small_solid_collision(), Stepping::dual);
    check_ulsph_methods(small_solid_collision(), Stepping::single);
  }
  TEST_CASE("naive: in 3D a block hit on its clamp follows the transcription with dual stepping") {
    check_ulsph_methods(small_clamped_block(), Stepping::dual);
  }
  TEST_CASE("total Lagrangian: in 3D collisions and a block hit on its clamp follow the transcription") {
    for (const Scene& scene : {small_solid_collision(), small_clamped_block()}) {
      CAPTURE(scene.name);
      check_total_lagrangian(scene, "tl");
      check_total_lagrangian(scene, "icb");
      check_total_lagrangian(scene, "tl-small-strain");
      check_total_lagrangian(scene, "tl-hg");
      check_total_lagrangian(scene, "tl-enog");
    }
  }
  TEST_CASE("mixed: in 3D collisions and a block hit on its clamp follow the transcription") {
    for (const std::string name : {"pf", "pf-jst", "pfj-jst", "pfhj-jst"}) {
      check_mixed(small_solid_collision(), name, 1);
      check_mixed(small_clamped_block(), name, 0);
    }
    check_mixed(small_solid_collision(), "pf", 0, "internal_force");
    for (const char* printed : {"internal_force", "deviator_ratio"})
      check_mixed(small_clamped_block(), "pfhj-jst", 1, printed);
  }
  TEST_CASE("oenog: in 3D a collision, a clamped block and two materials follow the transcription") {
    check_oenog(small_solid_collision(), true);
    check_oenog(small_clamped_block(), true);
    check_oenog(clamped_block_of_two_materials(), false);
  }
}

}  // namespace of_this_file
