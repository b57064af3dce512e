#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr int steps = 60;

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same_bytes(const Snapshot& a, const Snapshot& b) {
  return a.dim == b.dim && a.time == b.time && a.step == b.step && same(a.x0, b.x0) && same(a.x, b.x) &&
         same(a.v, b.v) && same(a.m, b.m) && same(a.rho, b.rho) && same(a.p, b.p) && same(a.s, b.s) &&
         same(a.diameter, b.diameter) && same(a.body, b.body) && same(a.clamped, b.clamped);
}

std::vector<Scene> probed_scenes() {
  std::vector<Scene> scenes = {small_collision(), small_clamped_plate()};
  for (Scene& scene : scenes) {
    Probe stress = make_probe("stress", Probe::Kind::stress);
    stress.at = scene.bodies[0].clamped ? Point{0.008, 0, 0} : Point{-0.0141, 0, 0};
    scene.probes = {make_probe("speed", Probe::Kind::mean_velocity),
                    make_probe("push", Probe::Kind::contact_force, {0, 1}), stress};
    if (scene.bodies[0].clamped) scene.probes.push_back(make_probe("clamp", Probe::Kind::reaction));
  }
  return scenes;
}

template <class F>
void for_each_run(const F& f) {
  for (const Scene& scene : probed_scenes()) {
    for (const MethodInfo& method : methods()) {
      const std::string name(method.name);
      CAPTURE(scene.name);
      CAPTURE(name);
      f(scene, name);
    }
  }
}

}  // namespace

TEST_SUITE("determinism") {
  TEST_CASE("threads: 1, 2 and 3 threads give the same bytes") {
    for_each_run([](const Scene& scene, const std::string& method) {
      Settings settings = with_method(method);
      // at first, up to 16 steps run on one thread
      const int few = 32;
      const auto alone = make_simulation(scene, settings);
      make_steps(*alone, few);
      const Snapshot one = alone->snapshot();
      for (const int threads : {2, 3}) {
        settings.threads = threads;
        CHECK(make_simulation(scene, settings)->threads() == threads);
        const auto simulation = make_simulation(scene, settings);
        make_steps(*simulation, few);
        CHECK(same_bytes(simulation->snapshot(), one));
        for (std::size_t k = 0; k < scene.probes.size(); ++k)
          CHECK(same(simulation->series().value[k], alone->series().value[k]));
      }
    });
  }

  TEST_CASE("threads: a scene expression is evaluated by one thread at a time") {
    // the parser of scene-file expressions has state
    static std::atomic<int> evaluations, overlaps;
    const auto alone = [](double value) {
      if (evaluations.fetch_add(1) > 0) ++overlaps;
      for (int k = 0; k < 2000; ++k) evaluations.load();  // lets another thread interfere
      evaluations.fetch_sub(1);
      return value;
    };
    for (Scene scene : {small_clamped_plate(), small_clamped_block()}) {
      for (Body& body : scene.bodies) {
        if (const auto clamped = body.clamped)
          body.clamped = [=](const Point& x) { return alone(clamped(x)); };
        for (Expression& of_one : body.velocity) {
          const auto velocity = of_one;
          of_one = [=](const Point& x) { return alone(velocity ? velocity(x) : 0); };
        }
      }
      for (const MethodInfo& method : methods()) {
        CAPTURE(method.name);
        Settings settings = with_method(std::string(method.name));
        settings.threads = 4;
        overlaps = 0;
        make_simulation(scene, settings);
        CHECK(overlaps.load() == 0);
      }
    }
  }

  TEST_CASE("threads: by default a small scene runs on one thread") {
    Settings settings = with_method("tl");
    settings.threads = 0;
    const auto simulation = make_simulation(small_collision(), settings);
    CHECK(simulation->snapshot().size() < 600);
    CHECK(simulation->threads() == 1);
  }

  TEST_CASE("runs: two equal runs give the same bytes, and bodies move") {
    for_each_run([](const Scene& scene, const std::string& method) {
      const Snapshot first = state_after(steps, scene, with_method(method));
      CHECK(same_bytes(first, state_after(steps, scene, with_method(method))));
      CHECK_FALSE(same_bytes(first, state_after(steps + 1, scene, with_method(method))));
      CHECK_FALSE(same(first.x, first.x0));
    });
  }

  TEST_CASE("instruction sets: every available instruction set gives the same bytes") {
    for_each_run([](const Scene& scene, const std::string& method) {
      Settings settings = with_method(method);
      const Snapshot best = state_after(steps, scene, settings);
      for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::x86_64_v3}) {
        settings.instruction_set = set;
        CHECK(same_bytes(state_after(steps, scene, settings), best));
      }
    });
  }

  TEST_CASE("output: 1, 10 and 100 outputs give the same bytes and the same series") {
    for_each_run([](const Scene& scene, const std::string& method) {
      const auto once = make_simulation(scene, with_method(method));
      // between two steps, so round-off does not matter
      const double until = 0.5 * (state_after(steps - 1, scene, with_method(method)).time +
                                  state_after(steps, scene, with_method(method)).time);
      once->advance_to(until);
      CHECK(once->steps() == steps);
      for (const int looks : {10, 100}) {
        const auto often = make_simulation(scene, with_method(method));
        for (int k = 1; k <= looks; ++k) often->advance_to(until * k / looks);
        CHECK(same_bytes(often->snapshot(), once->snapshot()));
        CHECK(same(often->series().time, once->series().time));
        CHECK(same(often->series().value[0], once->series().value[0]));
      }
      CHECK(once->series().time.size() == steps + 1);
    });
  }

  TEST_CASE("output: probes do not alter a run") {
    for_each_run([](const Scene& scene, const std::string& method) {
      Scene unwatched = scene;
      unwatched.probes.clear();
      CHECK(same_bytes(state_after(steps, unwatched, with_method(method)),
                       state_after(steps, scene, with_method(method))));
    });
  }

  TEST_CASE("stepping: dual and single stepping differ exactly for the methods that have cfl_advection") {
    for_each_run([](const Scene& scene, const std::string& method) {
      const Snapshot dual = state_after(steps, scene, with_method(method, Stepping::dual));
      const Snapshot single = state_after(steps, scene, with_method(method, Stepping::single));
      double difference = 0;
      for (std::size_t k = 0; k < dual.x.size(); ++k)
        difference = std::max(difference, std::abs(dual.x[k] - single.x[k]));
      const auto& constants = find_method(method)->constants;
      if (std::ranges::find(constants, "cfl_advection", &MethodConstant::name) == constants.end())
        CHECK(difference == 0);  // no geometry is kept between steps
      else
        CHECK(difference > 1e-3 * scene.spacing);
      const double most = method == "og" ? 1 : 0.1;  // og tears
      CHECK(difference < most * scene.spacing);
    });
  }
}

}  // namespace of_this_file
