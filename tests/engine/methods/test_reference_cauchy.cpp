#include <algorithm>
#include <cmath>
#include <limits>
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

/// [Khayyer2024]
const char* const ladder[] = {"ulsph-av-as-uncorrected",
                              "ulsph-av-as",
                              "d-ulsph-av-as",
                              "d-ulsph-av-tic",
                              "d-ulsph-r-as",
                              "ulsph-r-tic",
                              "d-ulsph-r-tic"};
/// [TranDuc2023] §2.2
const char* const current_configuration[] = {"ccb", "ccbwat"};

Scene two_materials() {
  Scene scene = small_clamped_plate();
  Material stiff = scene.materials[0];
  stiff.name = "stiff";
  stiff.density *= 1.5;
  stiff.youngs_modulus *= 3;
  scene.materials.push_back(stiff);
  scene.bodies[0].shapes = {Box{{0, -0.0035, 0}, {0.014, 0.0035, 0}},
                            Box{{-0.004, -0.0035, 0}, {0, 0.0035, 0}}};
  scene.bodies[0].parts = {{1, [](const Point& x) { return x[1] > 0 && x[0] > 0.004 ? 1.0 : 0.0; }}};
  scene.bodies[1].shapes = {Disc{{0.0003, 0.0068, 0}, 0.003}};
  return scene;
}

template <int Dim>
void check_agreement(const Snapshot& engine, const naive_cauchy::Run<Dim>& run, double share = 1e-10) {
  std::vector<double> x, v, rho, p, s;
  for (const naive_cauchy::Particle<Dim>& a : run.particles) {
    x.insert(x.end(), a.r.begin(), a.r.end());
    v.insert(v.end(), a.u.begin(), a.u.end());
    rho.push_back(a.rho);
    p.push_back(a.p());
    if constexpr (Dim == 2)
      s.insert(s.end(), {a.S(0, 0), a.S(0, 1), a.S(1, 1), -a.S.trace()});
    else
      s.insert(s.end(), {a.S(0, 0), a.S(0, 1), a.S(0, 2), a.S(1, 1), a.S(1, 2), a.S(2, 2)});
  }
  CHECK(engine.time == relative(run.time, 1e-12));
  check_field("x", engine.x, x, share);
  check_field("v", engine.v, v, share);
  check_field("rho", engine.rho, rho, share);
  check_field("p", engine.p, p, share);
  check_field("s", engine.s, s, share);
}

void check_active(const naive_cauchy::Counts& counts, const std::string& name) {
  const naive_cauchy::Method is = naive_cauchy::method_named(name);
  CHECK(counts.contacts > 20);
  CHECK(counts.tension > 100);
  CHECK(counts.compression > 100);
  CHECK((counts.viscous > 1000) == (is.av || is.riemann));
  CHECK((counts.diffused > 1000) == is.delta);
  CHECK((counts.inner > 100) == is.tic);
  CHECK((counts.outer > 100) == is.tic);
}

template <int Dim>
void check_limiters(const Scene& scene, const std::string& method) {
  const Snapshot published = state_after(40, scene, with_method(method));
  for (const double limiter : {1, 2, 3}) {
    CAPTURE(limiter);
    Settings settings = with_method(method);
    settings.constants["limiter"] = limiter;
    const naive_cauchy::Run<Dim> run = after_steps(naive_current<Dim>(scene, settings), 40);
    CHECK(run.counts.flattened > 1000);
    CHECK((run.counts.limited > 1000) == (limiter < 3));
    const Snapshot engine = state_after(40, scene, settings);
    check_agreement(engine, run, 1e-12);
    CHECK(engine.v != published.v);
  }
}

template <int Dim>
void check_variant(const Scene& scene, const std::string& method, const std::string& constant, double value) {
  constexpr int steps = Dim == 2 ? 25 : 40;
  CAPTURE(method);
  Settings settings = with_method(method);
  settings.constants[constant] = value;
  const naive_cauchy::Run<Dim> run = after_steps(naive_current<Dim>(scene, settings), steps);
  check_active(run.counts, method);
  const Snapshot engine = state_after(steps, scene, settings);
  check_agreement(engine, run);
  CHECK(engine.v != state_after(steps, scene, with_method(method)).v);
}

template <int Dim>
void check_method(const Scene& scene, const std::string& method, int steps) {
  CAPTURE(method);
  const Settings settings = with_method(method);
  const naive_cauchy::Run<Dim> run = after_steps(naive_current<Dim>(scene, settings), steps);
  check_active(run.counts, method);
  check_agreement(state_after(steps, scene, settings), run);
}

}  // namespace

TEST_SUITE("reference") {
  TEST_CASE("naive: the ladder follows the transcription for a plate of two materials hit by a disc") {
    for (const char* method : ladder) check_method<2>(two_materials(), method, 20);
  }
  TEST_CASE("naive: the ladder follows the transcription for a colliding ring and disc") {
    for (const char* method : ladder) check_method<2>(small_collision(), method, 16);
  }
  TEST_CASE("naive: ccb and ccbwat follow the transcription for a plate of two materials hit by a disc") {
    for (const char* method : current_configuration) check_method<2>(two_materials(), method, 25);
  }
  TEST_CASE("naive: in 3D the ladder, ccb and ccbwat follow the transcription in collisions and at a clamp") {
    Scene clamped = small_clamped_block();
    const double dp = clamped.spacing;
    // thick enough for particles outside the surface vicinity
    clamped.bodies[0].shapes = {Box{{-3 * dp, -2.5 * dp, -2.5 * dp}, {6 * dp, 2.5 * dp, 2.5 * dp}}};
    clamped.bodies[1].shapes = {Disc{{0.0003, 0.0052, 0.0002}, 0.0021}};
    for (const Scene& scene : {small_solid_collision(), clamped}) {
      CAPTURE(scene.name);
      for (const char* method : ladder) check_method<3>(scene, method, 40);
      for (const char* method : current_configuration) check_method<3>(scene, method, 40);
    }
  }
  TEST_CASE("naive: with riemann_factor = 2, as Eq. 43 prints, d-ulsph-r-tic follows the transcription") {
    const Scene scene = two_materials();
    Settings settings = with_method("d-ulsph-r-tic");
    settings.constants["riemann_factor"] = 2;
    const naive_cauchy::Run<2> run = after_steps(naive_current<2>(scene, settings), 16);
    settings.step = run.time / 16;  // the engine's step is shorter, see riemann_step_speed()
    const Snapshot engine = state_after(16, scene, settings);
    check_agreement(engine, run);
    CHECK(engine.v != state_after(16, scene, with_method("d-ulsph-r-tic")).v);
  }
  TEST_CASE("naive: the slope limiters of the Riemann term follow the transcription in 2D and 3D") {
    for (const char* method : {"d-ulsph-r-as", "ulsph-r-tic", "d-ulsph-r-tic"}) {
      CAPTURE(method);
      check_limiters<2>(small_collision(), method);
      check_limiters<3>(small_solid_collision(), method);
    }
  }
  TEST_CASE("naive: with (r/Δx)ⁿ, as printed, ccbwat follows the transcription in 2D and 3D") {
    check_variant<2>(two_materials(), "ccbwat", "repulsion_weight", 1);
    check_variant<3>(small_solid_collision(), "ccbwat", "repulsion_weight", 1);
  }
  TEST_CASE(
      "naive: with density diffusion of order 0 d-ulsph methods follow the transcription in 2D and 3D") {
    check_variant<2>(two_materials(), "d-ulsph-av-tic", "delta_order", 0);
    check_variant<3>(small_solid_collision(), "d-ulsph-r-as", "delta_order", 0);
  }
  TEST_CASE("naive: with ∇u at the start of the step, as printed, d-ulsph-r-tic follows the transcription") {
    const Scene scene = two_materials();
    Settings settings = with_method("d-ulsph-r-tic");
    settings.constants["geometry"] = 0;
    const Snapshot engine = state_after(16, scene, settings);
    check_agreement(engine, after_steps(naive_current<2>(scene, settings), 16));
    CHECK(engine.v != state_after(16, scene, with_method("d-ulsph-r-tic")).v);
  }
}

TEST_SUITE("unit") {
  TEST_CASE(
      "surface vicinity: reaches of 1.1, 1.2 and 1.3 spacings select the same particles, 1.48 selects others") {
    // some particles in the inner corner are 1.41 spacings from the surface
    Scene scene = small_collision();
    scene.bodies.pop_back();
    scene.bodies[0].shapes = {Box{{0, 0, 0}, {0.012, 0.012, 0}}, Box{{0.012, 0, 0}, {0.024, 0.006, 0}}};
    for (const MethodInfo& method : methods()) {
      const auto vicinity = std::ranges::find(method.constants, "vicinity", &MethodConstant::name);
      if (vicinity == method.constants.end()) continue;
      CAPTURE(std::string(method.name));
      CHECK(vicinity->value == 1.2);
      const auto after = [&](std::optional<double> reach) {
        Settings settings = with_method(std::string(method.name));
        if (reach) settings.constants["vicinity"] = *reach;
        return state_after(5, scene, settings).v;
      };
      CHECK(after({}) == after(1.1));
      CHECK(after(1.3) == after(1.1));
      CHECK(after(1.48) != after(1.1));
    }
  }
}

}  // namespace of_this_file
