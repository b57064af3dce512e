#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/archive.hpp"
#include "engine/error.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

void add_probes(Scene& scene) {
  scene.probes = {make_probe("speed", Probe::Kind::mean_velocity),
                  make_probe("gap", Probe::Kind::gap, {0, 1}),
                  make_probe("asymmetry", Probe::Kind::mirror_asymmetry, {0, 0})};
  scene.probes.back().axis = 1;
  scene.probes.push_back(make_probe("push", Probe::Kind::contact_force, {0, 1}));
  Probe stress = make_probe("stress", Probe::Kind::stress);
  stress.at = scene.bodies[0].clamped ? Point{0.008, 0, 0} : Point{-0.0141, 0, 0};
  stress.part = StressPart::xx;
  scene.probes.push_back(stress);
  if (scene.bodies[0].clamped) scene.probes.push_back(make_probe("clamp", Probe::Kind::reaction));
}

std::vector<Scene> watched_scenes() {
  std::vector<Scene> scenes = {small_collision(), small_clamped_plate()};
  for (Scene& scene : scenes) add_probes(scene);
  const double speed = 0.05 * ring_rubber().sound_speed(), until = 60 * 2e-6;
  Drive drive;
  drive.where = [](const Point& x) { return x[0] > 0.014 ? 1.0 : 0.0; };
  drive.velocity[1] = [=](double t) { return speed * std::cos(t / until); };
  drive.until = 0.5 * until;
  scenes.back().bodies[0].drives = {drive};
  Load load;
  load.where = [](const Point& x) { return x[0] > 0.01 ? 1.0 : 0.0; };
  load.value[0] = [](const Point& x) { return 50 + 1000 * x[1]; };
  load.ramp = [=](double t) { return std::min(1.0, 2 * t / until); };
  scenes.back().bodies[0].loads = {load};
  scenes.back().gravity[1] = [=](double t) { return -1000 * std::cos(t / until); };
  scenes.back().damping = 500;
  scenes.push_back(scenes.back());
  scenes.back().bodies[0].drives[0].until = {};
  return scenes;
}

bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void check_same(const Simulation& a, const Simulation& b) {
  const Snapshot &x = a.snapshot(), &y = b.snapshot();
  CHECK(x.time == y.time);
  CHECK(x.step == y.step);
  CHECK(x.contact_energy == y.contact_energy);
  CHECK(x.work == y.work);
  CHECK(x.damped == y.damped);
  for (const auto member : {&Snapshot::x0, &Snapshot::x, &Snapshot::v, &Snapshot::m, &Snapshot::rho,
                            &Snapshot::p, &Snapshot::s, &Snapshot::strain_energy, &Snapshot::diameter})
    CHECK(same_bytes(x.*member, y.*member));
  CHECK(a.pairs() > 0);
  CHECK(a.pairs() == b.pairs());
  CHECK(same_bytes(a.series().time, b.series().time));
  REQUIRE(a.series().value.size() == b.series().value.size());
  for (std::size_t k = 0; k < a.series().value.size(); ++k)
    CHECK(same_bytes(a.series().value[k], b.series().value[k]));
}

void check_restarts(const Scene& scene, const Settings& settings) {
  constexpr std::array<int, 5> saved_at = {0, 1, 17, 31, 50};
  constexpr int steps = 60;
  const auto straight = make_simulation(scene, settings);
  make_steps(*straight, steps);
  const auto saving = make_simulation(scene, settings);
  for (const int at : saved_at) {
    make_steps(*saving, at - saving->steps());
    const auto resumed = make_simulation(scene, settings);
    make_steps(*resumed, 3);
    resumed->load(saving->save());
    CAPTURE(at);
    check_same(*resumed, *saving);
    make_steps(*resumed, steps - at);
    check_same(*resumed, *straight);
  }
  make_steps(*saving, steps - saving->steps());
  check_same(*saving, *straight);
}

template <class T>
std::string bytes_of(T value) {
  Saver saver;
  saver(value);
  return saver.take();
}

}  // namespace

TEST_SUITE("restart") {
  TEST_CASE("a stopped simulation ends after the current step and continues to the same bytes") {
    std::atomic<int> stop = 0;
    Scene scene = small_collision();
    const auto straight = make_simulation(scene, with_method("enog"));
    make_steps(*straight, 30);
    scene.gravity[1] = [&](double t) {
      if (straight->time() * 0.5 < t) stop = 1;  // like a signal during a step
      return 0.0;
    };
    const auto stopped = make_simulation(scene, with_method("enog"));
    stopped->set_stop_flag(stop);
    stopped->advance_to(1e9);
    CHECK(stopped->time() < 0.6 * straight->time());
    const long steps = stopped->steps();
    stopped->advance_to(1e9);
    CHECK(stopped->steps() == steps);
    while (stopped->steps() < straight->steps()) {
      stop = 0;
      stopped->advance_to(1e9);
    }
    check_same(*stopped, *straight);
  }

  TEST_CASE("a saved and loaded simulation gives the same bytes with every method and contact law") {
    for (Scene scene : watched_scenes()) {
      for (const MethodInfo& method : methods()) {
        for (const ContactLaw law : method.contact_laws) {
          scene.contact = law;
          CAPTURE(scene.name);
          CAPTURE(method.name);
          CAPTURE(name(law));
          Scene run = scene;
          if (law == ContactLaw::sph && method.formulation.family == Family::ul_cauchy)
            std::erase_if(run.probes, [](const Probe& p) { return p.kind == Probe::Kind::contact_force; });
          check_restarts(run, with_method(std::string(method.name)));
        }
      }
    }
  }

  TEST_CASE("a saved state resumes with another instruction set and number of threads") {
    for (const MethodInfo& method : methods()) {
      CAPTURE(method.name);
      Settings settings = with_method(std::string(method.name));
      const Scene scene = watched_scenes()[0];
      const auto straight = make_simulation(scene, settings);
      make_steps(*straight, 12);
      const std::string state = straight->save();
      make_steps(*straight, 12);
      settings.instruction_set = InstructionSet::baseline;
      settings.threads = 2;
      const auto resumed = make_simulation(scene, settings);
      resumed->load(state);
      make_steps(*resumed, 12);
      check_same(*resumed, *straight);
    }
  }

  TEST_CASE("a state of other particles or probes, or of wrong length, is refused") {
    for (const MethodInfo& method : methods()) {
      CAPTURE(method.name);
      const Settings settings = with_method(std::string(method.name));
      const Scene scene = watched_scenes()[0];
      const auto simulation = make_simulation(scene, settings);
      const std::string state = simulation->save();
      CHECK_THROWS_AS(simulation->load(state.substr(0, state.size() - 1)), UsageError);
      CHECK_THROWS_AS(simulation->load(state.substr(0, 100)), UsageError);
      CHECK_THROWS_AS(simulation->load(""), UsageError);
      CHECK_THROWS_AS(simulation->load(state + "x"), UsageError);
      CHECK_THROWS_AS(make_simulation(watched_scenes()[1], settings)->load(state), UsageError);
      Scene unwatched = scene;
      unwatched.probes.clear();
      CHECK_THROWS_AS(make_simulation(unwatched, settings)->load(state), UsageError);
      simulation->load(state);
    }
  }

  TEST_CASE("archive: saved containers and optional values are loaded unchanged") {
    const std::map<int, double> map = {{3, 0.5}, {7, -1.0}};
    const std::vector<bool> bits = {true, false, true, true};
    std::vector<std::pair<int, std::string>> pairs = {{1, "one"}, {2, ""}};
    std::optional<std::vector<double>> full = std::vector<double>{1, 2}, empty;
    Saver saver;
    auto copies = std::tuple(map, bits, pairs, full, empty);
    std::apply([&](auto&... value) { saver(value...); }, copies);
    const std::string bytes = saver.take();
    auto found = std::tuple(std::map<int, double>{{1, 1}}, std::vector<bool>(9), decltype(pairs)(5),
                            std::optional<std::vector<double>>(), full);
    Loader loader(bytes);
    std::apply([&](auto&... value) { loader(value...); }, found);
    loader.finish();
    CHECK((found == std::tuple(map, bits, pairs, full, empty)));
  }

  TEST_CASE("archive: an impossible length is refused before memory is allocated") {
    const std::string bytes = bytes_of<std::uint64_t>(1ULL << 60);
    std::vector<double> values;
    CHECK_THROWS_AS(Loader{bytes}(values), UsageError);
    std::string text;
    CHECK_THROWS_AS(Loader{bytes}(text), UsageError);
  }

  TEST_CASE("archive: a saved value that differs from the required one is refused") {
    Saver saver;
    saver.match(5);
    const std::string bytes = saver.take();
    Loader(bytes).match(5);
    CHECK_THROWS_AS(Loader(bytes).match(6), UsageError);
  }
}

}  // namespace of_this_file
