
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/bonded/layout/off_lattice.hpp"
#include "engine/scene/shapes/given_particles.hpp"
#include "engine/scene/shapes/polygon.hpp"
#include "tests/engine/methods/bonded/cantilever_3d.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.001;
constexpr double h_over_dp = 0.9;

Scene block(int n) {
  Scene scene = small_solid_collision();
  scene.bodies.pop_back();
  scene.bodies[0].shapes = {Box{{0, 0, 0}, {n * dp, n * dp, n * dp}}};
  return scene;
}

Scene square(int n) {
  Scene scene = small_collision();
  scene.bodies.resize(1);
  scene.bodies[0].shapes = {Box{{0, 0, 0}, {n * dp, n * dp, 0}}};
  scene.bodies[0].velocity = {};
  scene.spacing = dp;
  return scene;
}

/// One particle per dp³.
Scene body_centred(int n) {
  Scene scene = block(n);
  const double cell = std::cbrt(2.0) * dp;
  std::vector<Point> places;
  for (int x = 0; x < 2 * n; ++x)
    for (int y = 0; y < 2 * n; ++y)
      for (int z = 0; z < 2 * n; ++z)
        if (x % 2 == y % 2 && y % 2 == z % 2) places.push_back({x * cell / 2, y * cell / 2, z * cell / 2});
  const std::vector<double> volumes(places.size(), dp * dp * dp);
  scene.bodies[0].shapes = {GivenParticles(std::move(places), volumes, 3)};
  return scene;
}

struct Own {
  std::vector<Eigen::Vector3d> X;
  std::vector<double> w;
};
Own own_bonds(const Bonds& bonds, int i) {
  Own own;
  for (int b = bonds.begin[i]; b < bonds.begin[i + 1]; ++b) {
    if (bonds.of(i, b).weight == 0) continue;
    own.X.push_back(Eigen::Vector3d(bonds.of(i, b).X.data()));
    own.w.push_back(bonds.of(i, b).weight);
  }
  return own;
}

/// Time at which the first probe returns to its start.
double half_period(const Scene& scene, double until, const Settings& settings = with_damping(0)) {
  const auto simulation = make_simulation(scene, settings);
  simulation->advance_to(until);
  const std::vector<double>&t = simulation->series().time, &y = simulation->series().value[0];
  for (std::size_t k = 2; k < t.size(); ++k)
    if ((y[k - 1] > 0) != (y[k] > 0)) return t[k - 1] + (t[k] - t[k - 1]) * y[k - 1] / (y[k - 1] - y[k]);
  FAIL("the probe does not return to its start");
  return 0;
}

Scene ringing(double spacing) {
  Scene scene = colliding_rings(0, spacing);
  scene.bodies.pop_back();
  scene.bodies[0].shapes = {Ring{{}, 0.03, 0.04}};
  scene.bodies[0].mirror[0] = false;
  scene.bodies[0].velocity[0] = [](const Point& x) { return 5 * x[0]; };
  scene.bodies[0].velocity[1] = [](const Point& x) { return -5 * x[1]; };
  scene.probes = {make_probe("side", Probe::Kind::displacement)};
  scene.probes[0].at = {0.035, 0, 0};
  return scene;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("off-lattice: inside a lattice bonds are as stiff as the solid, and at a face they are softer") {
    const Scene scene = block(5);
    const Bonds bonds = make_bonds(scene, make_initial_particles(scene), h_over_dp * dp);
    CHECK_FALSE(bonds.off_lattice);
    const Own middle = own_bonds(bonds, 62), face = own_bonds(bonds, 12), corner = own_bonds(bonds, 0);
    CHECK(excess(middle.X, middle.w) == relative(1, 1e-9));
    CHECK(excess(face.X, face.w) < 0.99);
    CHECK(excess(corner.X, corner.w) < 0.9);
    std::vector<double> doubled = middle.w;
    for (double& w : doubled) w *= 2;
    CHECK(excess(middle.X, doubled) == relative(2, 1e-9));
    CHECK(excess(std::vector{Eigen::Vector3d(1, 0, 0)}, {1}) == relative(0.4, 1e-9));
    using Flat = std::vector<Eigen::Vector2d>;
    const Flat square{{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
    CHECK(excess(square, std::vector(8, 1.0)) == relative(1, 1e-9));
    CHECK(excess(Flat{{1, 0}}, {1}) == relative(0.375, 1e-9));
    CHECK_FALSE(is_at_surface(square));
    CHECK(is_at_surface(Flat{{1, 0}, {0, 1}}));
    CHECK(is_at_surface(Flat{{1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}}));
    CHECK_FALSE(is_at_surface(middle.X));
    CHECK(is_at_surface(face.X));
    CHECK(is_at_surface(corner.X));
    CHECK(is_on_lattice(face.X, dp));
    CHECK_FALSE(is_on_lattice(face.X, 1.01 * dp));
  }

  TEST_CASE(
      "off-lattice: the bonds of over a quarter of the particles are as stiff as the solid, and no bonds are stiffer") {
    for (const Scene& scene : {jittered(block(7), 0.2), body_centred(7)}) {
      const InitialParticles initial = make_initial_particles(scene);
      const Bonds bonds = make_bonds(scene, initial, h_over_dp * dp);
      CHECK(bonds.off_lattice);
      double greatest = 0;
      int as_stiff = 0;
      for (int i = 0; i < initial.size(); ++i) {
        const Own own = own_bonds(bonds, i);
        const double stiff = excess(own.X, own.w);
        greatest = std::max(greatest, stiff);
        as_stiff += stiff > 1 - 1e-8;
        CHECK(*std::ranges::min_element(own.w) > 0);
        Eigen::Matrix3d one = Eigen::Matrix3d::Zero();
        for (int b = bonds.begin[i]; b < bonds.begin[i + 1]; ++b)
          one += Eigen::Vector3d(bonds.of(i, b).X.data()) * Eigen::RowVector3d(bonds.gradient(i, b).data());
        CHECK((one - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-12);
      }
      CHECK(greatest < 1 + 1e-8);
      CHECK(as_stiff > initial.size() / 4);
    }
  }
}

TEST_SUITE("failure") {
  TEST_CASE("oenog: an off-lattice body has the same bonds as the first and as the second body") {
    Scene scene = square(6);
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].name = "bar";
    scene.bodies[1].shapes = {
        Polygon({{{0.05, 0, 0}, {0.069, 0.004, 0}, {0.067, 0.013, 0}, {0.048, 0.009, 0}}})};
    scene.bodies[1].relaxed = true;
    scene.bodies[1].velocity[1] = [](const Point& x) { return 1e4 * (x[0] - 0.06) * (x[0] - 0.06); };
    const Snapshot second = state_after(20, scene, with_method("oenog"));
    std::swap(scene.bodies[0], scene.bodies[1]);
    const Snapshot first = state_after(20, scene, with_method("oenog"));
    const std::size_t n = 2 * static_cast<std::size_t>(std::ranges::count(first.body, 0));
    double moved = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t other = second.x.size() - n + k;
      CHECK(std::abs(first.x[k] - second.x[other]) < 1e-9 * dp);
      moved = std::max(moved, std::abs(first.x[k] - first.x0[k]));
    }
    CHECK(moved > 1e-3 * dp);
  }

  TEST_CASE("oenog: an off-lattice body with bonds in single precision stays at rest") {
    Scene layers = block(7);
    layers.bodies[0].shapes = {Ring{{}, 3 * dp, 6 * dp, RoundLayout::aligned}};
    for (Scene scene : {layers, jittered(block(7), 0.2)}) {
      scene.bodies[0].velocity = {};
      const auto simulation = make_simulation(scene, with_damping(0));
      make_steps(*simulation, 200);
      const double sound = std::sqrt(scene.materials[0].youngs_modulus / scene.materials[0].density);
      for (const double v : simulation->snapshot().v) CHECK(std::abs(v) < 1e-12 * sound);
    }
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("oenog: jittered bodies start without stress") {
    for (const int n : {40, 55}) {  // at 55 the balance has over 12000 equations
      CAPTURE(n);
      Scene scene = jittered(square(n), 0.1);
      const Snapshot now = make_simulation(scene, with_method("oenog"))->snapshot();
      double energy = 0, greatest = 0;
      for (std::size_t i = 0; i < now.size(); ++i)
        energy += std::abs(now.strain_energy[i]), greatest = std::max(greatest, std::abs(now.p[i]));
      CHECK(energy < 1e-12 * ring_rubber().bulk_modulus() * n * n * dp * dp);
      CHECK(greatest < 1e-9 * ring_rubber().bulk_modulus());
    }
  }

  TEST_CASE("oenog: jitter prolongs the bending period of a bar, to less than 6.6 % above finite elements") {
    constexpr double period = 0.27691;  // finite elements
    const double lattice = error_of_period(bending_cantilever(5), period),
                 little = error_of_period(jittered(bending_cantilever(5), 0.1), period),
                 much = error_of_period(jittered(bending_cantilever(5), 0.2), period);
    CHECK(lattice < little);
    CHECK(little < 0.025);
    CHECK(little < much);
    CHECK(much < 0.066);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE(
      "oenog: a plate's period is unchanged by round-off in positions, and within 0.9 % up to a jitter of 1e-3") {
    const Scene plate = oscillating_plate(0.01, 5);
    const double lattice = half_period(plate, 0.15);
    constexpr double exact = 0.25522 / 2;
    CHECK(lattice == relative(exact, 0.003));
    for (const double share : {1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-7, 1e-5, 1e-3}) {
      CAPTURE(share);
      const double period = half_period(jittered(plate, share), 0.2);
      if (share < 1e-11)
        CHECK(period == relative(lattice, 1e-5));
      else
        CHECK(period == relative(exact, 0.009));
    }
  }

  TEST_CASE(
      "oenog: a jittered ring vibrates slightly too slowly, a finer ring less so, and a plate at most 4 % too slowly") {
    const auto too_slow = [](const Scene& scene, double share, double lattice) {
      return half_period(jittered(scene, share), 1.5 * lattice) / lattice - 1;
    };
    const Scene coarse = ringing(0.002), fine = ringing(0.001), plate = oscillating_plate(0.01, 10);
    const double of_coarse = half_period(coarse, 0.006), of_fine = half_period(fine, 0.006),
                 of_plate = half_period(plate, 0.15);
    for (const auto& [share, most] : {std::pair(0.1, 0.01), std::pair(0.2, 0.03)}) {
      CAPTURE(share);
      const double of_two = too_slow(coarse, share, of_coarse), of_one = too_slow(fine, share, of_fine);
      CHECK(of_one > 0);
      CHECK(of_one < most);
      CHECK(of_one < of_two);
      CHECK(of_two < 2 * most);
    }
    CHECK(too_slow(plate, 0.1, of_plate) < 0.015);
    CHECK(too_slow(plate, 0.2, of_plate) < 0.04);
  }
}

TEST_SUITE("failure") {
  TEST_CASE("tl: a plate jittered by 0.1 dp is far softer than on the lattice") {
    const Scene plate = oscillating_plate(0.01, 10);
    const auto half = [](const Scene& scene) { return half_period(scene, 0.2, with_method("tl")); };
    CHECK(half(jittered(plate, 0.1)) > 1.2 * half(plate));
  }

  TEST_CASE("oenog: an off-lattice block is stable at the default step and conserves its energy") {
    for (const double share : {0.1, 0.2, 0.3, 0.4, 0.45}) {
      CAPTURE(share);
      const Scene scene = jittered(block(7), share);
      const auto simulation = make_simulation(scene, with_damping(0));
      const double start = balance(simulation->snapshot(), scene).kinetic;
      const std::array<double, 3> momentum = balance(simulation->snapshot(), scene).linear_momentum;
      make_steps(*simulation, 1000);
      const Balance now = balance(simulation->snapshot(), scene);
      CHECK(now.kinetic + now.strain == relative(start, 2e-3));
      for (int k = 0; k < 3; ++k)
        CHECK(std::abs(now.linear_momentum[k] - momentum[k]) < 1e-12 * std::abs(momentum[0]));
    }
  }

  TEST_CASE("oenog: in 2D a jittered plate keeps vibrating and conserves its energy") {
    for (const double share : {0.1, 0.2, 0.3}) {
      CAPTURE(share);
      const Scene scene = jittered(oscillating_plate(0.01, 10), share);
      const auto simulation = make_simulation(scene, with_damping(0));
      const double start = balance(simulation->snapshot(), scene).kinetic;
      make_steps(*simulation, 3000);
      const Balance now = balance(simulation->snapshot(), scene);
      CHECK(now.kinetic + now.strain == relative(start, 1e-2));
      CHECK(now.strain > 0.1 * start);
    }
  }

  TEST_CASE("oenog: a jittered body with a tip of single particles conserves its energy") {
    Scene scene = oscillating_plate(0.01, 5);
    const double spacing = scene.spacing, L = 0.05;
    scene.bodies[0].shapes = {Box{{0, 0, 0}, {L, 10 * spacing, 0}},
                              Box{{L, 4 * spacing, 0}, {L + 3 * spacing, 5 * spacing, 0}}};
    scene.probes.clear();
    scene.bodies[0].clamped = {};
    scene.bodies[0].velocity[0] = scene.bodies[0].velocity[1] = [](const Point& x) {
      return 0.5 * std::sin(x[1] / 0.01 + x[0] / 0.02);
    };
    for (const int seed : {1, 2, 3}) {
      CAPTURE(seed);
      scene.jitter = {0.1, seed};
      const auto simulation = make_simulation(scene, with_damping(0));
      const double start = balance(simulation->snapshot(), scene).kinetic;
      make_steps(*simulation, 1000);
      const Balance now = balance(simulation->snapshot(), scene);
      CHECK(now.kinetic + now.strain == relative(start, 0.01));
      CHECK(now.strain > 0.1 * start);
    }
  }

  TEST_CASE("oenog: parts separated by a slot of one spacing have no bonds with each other") {
    Scene scene = square(10);
    scene.bodies[0].shapes = {Box{{-20 * dp, 0, 0}, {0, 10 * dp, 0}}, Box{{dp, 0, 0}, {21 * dp, 10 * dp, 0}}};
    scene.bodies[0].velocity[0] = [](const Point& x) { return x[0] > 0 ? 1.0 : 0.0; };
    SUBCASE("on a hexagonal lattice") { scene.bodies[0].lattice = Lattice::hexagonal; }
    SUBCASE("with bonds of two spacings") { scene.jitter.share = 1e-6; }
    const auto simulation = make_simulation(scene, with_method("oenog"));
    simulation->advance_to(0.01);
    const Snapshot now = simulation->snapshot();
    for (std::size_t i = 0; i < now.size(); ++i)
      REQUIRE(std::abs(now.v[2 * i] - (now.x0[2 * i] > 0 ? 1 : 0)) < 1e-6);
  }

  TEST_CASE("oenog: steps of off-lattice bodies are at most 20 % shorter than on a lattice") {
    const auto time_of = [](const Scene& scene) {
      const auto simulation = make_simulation(scene, with_method("oenog"));
      make_steps(*simulation, 20);
      return simulation->time();
    };
    const Scene plate = oscillating_plate(0.01, 5);
    CHECK(time_of(jittered(plate, 0.2)) == relative(time_of(plate), 0.01));
    const double lattice = time_of(block(6));
    CHECK(time_of(jittered(block(6), 0.05)) == relative(lattice, 0.05));
    for (const double share : {0.2, 0.45}) {
      const double jumbled = time_of(jittered(block(6), share)) / lattice;
      CHECK(jumbled > 0.8);
      CHECK(jumbled < 1.05);
    }
  }
}

}  // namespace of_this_file
