#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

Scene touching_blocks(int dim) {
  const double dp = 0.001, depth = dim == 3 ? 0.002 : 0;
  Scene scene;
  scene.name = "touching-blocks";
  scene.dim = dim;
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  Body left, right;
  left.name = "left";
  left.shapes = {Box{{-0.0065, -0.002, -depth}, {-0.0005, 0.002, depth}}};
  left.velocity[0] = constant(0.1 * ring_rubber().sound_speed());
  right = left;
  right.name = "right";
  right.shapes = {Box{{0.0002, -0.002, -depth}, {0.0062, 0.002, depth}}};
  right.velocity[0] = constant(0);
  right.clamped = [](const Point& x) { return x[0] > 0.005 ? 1.0 : 0.0; };
  Drive drive;
  drive.where = [](const Point& x) { return x[0] < -0.0055 ? 1.0 : 0.0; };
  drive.velocity[0] = [](double t) { return 5 + t; };
  drive.until = 1e-5;
  left.drives = {drive};
  Load load;
  load.where = [](const Point&) { return 1.0; };
  load.value[0] = constant(dim == 2 ? 1000 : 1);
  right.loads = {load};
  scene.bodies = {left, right};
  scene.walls = {{"floor", {0, -0.0021, 0}, {0, 1, 0}}};
  scene.probes = {make_probe("speed", Probe::Kind::mean_velocity),
                  make_probe("gap", Probe::Kind::gap, {0, 1})};
  return scene;
}

/// Two near parts are far apart in the reference configuration.
Scene folded_block(int dim) {
  Scene scene = touching_blocks(dim);
  scene.name = "folded-block";
  const Shape far = Box{{0.0065, -0.002, dim == 3 ? -0.002 : 0}, {0.0115, 0.002, dim == 3 ? 0.002 : 0}};
  scene.bodies.pop_back();
  scene.bodies[0].shapes.push_back(far);
  scene.bodies[0].displacement[0] = [](const Point& x) { return x[0] > 0 ? -0.006 : 0.0; };
  scene.probes.pop_back();
  return scene;
}

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, std::min(sizeof value, bytes.size() - at));
}

constexpr int kinds_of_damage = 10;
void damage(std::string& bytes, std::size_t at, int kind, int particles) {
  switch (kind) {
    case 0:
      return put<std::int32_t>(bytes, at, -1);
    case 1:
      return put(bytes, at, std::numeric_limits<std::int32_t>::min());
    case 2:
      return put(bytes, at, std::numeric_limits<std::int32_t>::max());
    case 3:
      return put<std::int32_t>(bytes, at, particles);
    case 4:
      return put<std::int32_t>(bytes, at, 1000000);  // beyond the arrays
    case 5:
      return put(bytes, at, std::numeric_limits<double>::quiet_NaN());
    case 6:
      return put(bytes, at, 1e300);
    case 7:
      return put<std::int64_t>(bytes, at, std::int64_t{1} << 40);
    case 8:
      return put<std::uint8_t>(bytes, at, 2);
    default:
      return put(bytes, at, -std::numeric_limits<double>::infinity());
  }
}

struct Tally {
  long changed = 0, refused = 0, diverged = 0, went_on = 0;
};

void try_state(const std::string& state, const Scene& scene, const Settings& settings, Tally& count) {
  const auto simulation = make_simulation(scene, settings);
  ++count.changed;
  try {
    simulation->load(state);
  } catch (const UsageError& e) {
    ++count.refused;
    CHECK(std::string(e.what()).starts_with("the saved state is damaged"));
    return;
  } catch (const NumericalError&) {
    ++count.diverged;
    return;
  }
  try {
    for (int k = 0; k < 4; ++k)
      simulation->advance_to(std::nextafter(simulation->time(), std::numeric_limits<double>::infinity()));
    simulation->snapshot();
    simulation->save();
    ++count.went_on;
  } catch (const NumericalError&) {
    ++count.diverged;
  }
}

long words_to_damage(long few) {
  const char* const words = std::getenv("TAUT_DAMAGED_WORDS");
  return words ? std::atol(words) : few;
}

}  // namespace

TEST_SUITE("restart") {
  TEST_CASE("a state with a random word changed is refused, or runs without memory errors") {
    std::mt19937 random(18);
    Tally count;
    for (const char* method : {"enog", "oas", "ccbwat", "d-ulsph-r-tic", "tl", "pfj-jst", "oenog"}) {
      for (const int dim : {2, 3}) {
        for (const Scene& base : {touching_blocks(dim), folded_block(dim)}) {
          const MethodInfo& info = *find_method(method);
          if (!info.keeps_neighbors && base.bodies.size() == 1) continue;
          for (const ContactLaw law : info.contact_laws) {
            Scene scene = base;
            scene.contact = law;
            CAPTURE(scene.name);
            CAPTURE(method);
            CAPTURE(name(law));
            CAPTURE(dim);
            const Settings settings = with_method(method);
            const auto whole = make_simulation(scene, settings);
            make_steps(*whole, 5);
            const std::string state = whole->save();
            const int particles = static_cast<int>(whole->snapshot().size());
            for (long k = 0; k < words_to_damage(10); ++k) {
              std::string damaged = state;
              const std::size_t at = random() % state.size();
              const int kind = static_cast<int>(random() % kinds_of_damage);
              damage(damaged, at, kind, particles);
              CAPTURE(at);
              CAPTURE(kind);
              try_state(damaged, scene, settings, count);
            }
          }
        }
      }
    }
    MESSAGE(count.changed << " words changed: " << count.refused << " refused, " << count.diverged
                          << " diverged, " << count.went_on << " went on");
    CHECK(count.refused > 0);
    CHECK(count.went_on > 0);
  }
}

}  // namespace of_this_file
