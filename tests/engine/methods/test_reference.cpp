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

constexpr int steps = 48;

naive::Run<2> naive_run(const Scene& scene, const Settings& settings) {
  naive::Run<2> run = after_steps(naive_split<2>(scene, settings), steps);
  run.finish();
  return run;
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
  CHECK(greatest_stress > 1e4);
  check_field("x", engine.x, x);
  check_field("v", engine.v, v);
  check_field("rho", engine.rho, rho);
  check_field("p", engine.p, p);
  check_field("s", engine.s, s);
}

void check_all_methods(const Scene& scene, Stepping stepping) {
  for (const std::string name : {"og", "oas", "enog", "enog-nonconservative", "gnog", "gnog-amc"}) {
    CAPTURE(name);
    const Settings settings = with_method(name, stepping);
    const naive::Run<2> run = naive_run(scene, settings);
    CHECK(run.contacts > 100);
    if (stepping == Stepping::single)
      CHECK(run.rebuilds == steps);
    else
      CHECK((run.rebuilds > 4 && run.rebuilds < steps / 2));
    check_agreement(state_after(steps, scene, settings), run, scene.materials[0].sound_speed());
  }
}

}  // namespace

TEST_SUITE("reference") {
  TEST_CASE("naive: a colliding ring and disc follow the transcription with dual stepping") {
    check_all_methods(small_collision(), Stepping::dual);
  }
  TEST_CASE("naive: a colliding ring and disc follow the transcription with single stepping") {
    check_all_methods(small_collision(), Stepping::single);
  }
  TEST_CASE("naive: a plate hit on its clamp follows the transcription with dual stepping") {
    check_all_methods(small_clamped_plate(), Stepping::dual);
  }
  TEST_CASE("naive: a plate hit on its clamp follows the transcription with single stepping") {
    check_all_methods(small_clamped_plate(), Stepping::single);
  }
  TEST_CASE("naive: the full U* with pressure diffusion follows the transcription") {
    const Scene scene = small_collision();
    const double c0 = scene.materials[0].sound_speed();
    Settings settings = with_method("enog");
    const naive::Run<2> without = naive_run(scene, settings);
    settings.constants["pressure_diffusion"] = 1;
    const naive::Run<2> run = naive_run(scene, settings);
    CHECK(std::abs(run.particles[0].p - without.particles[0].p) > 1e-3 * std::abs(run.particles[0].p));
    check_agreement(state_after(steps, scene, settings), run, c0);
  }
  TEST_CASE("naive: gnog-amc with a rotated penalty follows the transcription") {
    const Scene scene = small_collision();
    Settings settings = with_method("gnog-amc");
    const naive::Run<2> without = naive_run(scene, settings);
    settings.constants["penalty_rotation"] = 1;
    const naive::Run<2> run = naive_run(scene, settings);
    const auto &a = run.particles[0].v, &b = without.particles[0].v;
    CHECK(std::hypot(a[0] - b[0], a[1] - b[1]) > 1e-3 * std::hypot(a[0], a[1]));
    check_agreement(state_after(steps, scene, settings), run, scene.materials[0].sound_speed());
  }
  TEST_CASE("naive: the cubic B-spline as kernel follows the transcription") {
    const Scene scene = small_collision();
    const double c0 = scene.materials[0].sound_speed();
    for (const char* method : {"og", "oas", "enog", "enog-nonconservative"}) {
      CAPTURE(method);
      Settings settings = with_method(method);
      settings.constants["cubic_spline"] = 1;
      check_agreement(state_after(steps, scene, settings), naive_run(scene, settings), c0);
    }
  }
}

}  // namespace of_this_file
