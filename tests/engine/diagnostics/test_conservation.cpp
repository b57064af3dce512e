#include <doctest/doctest.h>

#include "engine/diagnostics/conservation.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

Snapshot particle(bool clamped) {
  Snapshot start;
  start.clamped = {static_cast<unsigned char>(clamped)};
  return start;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE(
      "conservation: drift is relative to the greatest scale, and momentum drift is absent for a clamped body") {
    Balance start;
    start.kinetic = 4;
    start.linear_momentum = {1, 0, 0};
    start.momentum_scale = 2;
    Balance later = start;
    later.kinetic = 1;
    later.strain = 2;
    later.linear_momentum = {1, 0.5, 0};
    later.momentum_scale = 5;
    for (const bool clamped : {false, true}) {
      ConservationWatch watch(Scene(), particle(clamped));
      for (const Balance& sums : {start, later, start}) watch.follow(sums);
      const Conservation found = watch.so_far();
      REQUIRE(found.energy);
      CHECK(*found.energy == Approx(0.25));
      REQUIRE(found.linear_momentum.has_value() == !clamped);
      CHECK(found.angular_momentum == (clamped ? std::nullopt : std::optional(0.0)));
      if (!clamped) CHECK(*found.linear_momentum == Approx(0.1));
    }
  }

  TEST_CASE("conservation: wall impulses are not drift") {
    Balance start;
    start.linear_momentum = {0, -2, 0};
    start.angular_momentum = {0, 0, 3};
    start.momentum_scale = 2;
    start.angular_scale = 5;
    Balance later = start;
    later.linear_momentum = {0, 2, 0};
    later.angular_momentum = {0, 0, -1};
    later.of_walls = {{0, 3, 0}, {0, 0, -3}};
    ConservationWatch watch(Scene(), particle(false));
    watch.follow(start);
    watch.follow(later);
    CHECK(*watch.so_far().linear_momentum == Approx(0.5));
    CHECK(*watch.so_far().angular_momentum == Approx(0.2));
  }

  TEST_CASE("conservation: bodies at rest on which nothing acts have no drift of momentum") {
    ConservationWatch watch(Scene(), particle(false));
    watch.follow(Balance());
    watch.follow(Balance());
    CHECK(*watch.so_far().linear_momentum == 0);
    CHECK(*watch.so_far().angular_momentum == 0);
  }

  TEST_CASE("conservation: energy drift excludes external work and damping") {
    Balance start, later;
    later.kinetic = 3;
    later.strain = 2;
    later.work = 4;
    ConservationWatch watch(Scene(), particle(false));
    CHECK_FALSE(watch.so_far().energy);
    watch.follow(start);
    CHECK_FALSE(watch.so_far().energy);
    watch.follow(later);
    CHECK(*watch.so_far().energy == Approx(0.25));
    later.damped = 2;
    ConservationWatch damped(Scene(), particle(false));
    damped.follow(start);
    damped.follow(later);
    CHECK(*damped.so_far().energy == Approx(0.75));
  }

  TEST_CASE("conservation: energy drift is the greater of gained and lost energy") {
    Balance start, lost, gained;
    start.kinetic = 10, lost.kinetic = 7, gained.kinetic = 11;
    ConservationWatch watch(Scene(), particle(false));
    for (const Balance& sums : {start, lost, gained}) watch.follow(sums);
    CHECK(*watch.so_far().energy_lost == Approx(0.3));
    CHECK(*watch.so_far().energy_gained == Approx(0.1));
    CHECK(*watch.so_far().energy == Approx(0.3));
  }

  TEST_CASE("conservation: energy drift is absent if the energy is only round-off") {
    Scene scene;
    scene.materials = {{"rubber", /*ρ0*/ 1000, /*E*/ 1e6, /*ν*/ 0.3}};
    Balance start, later;
    start.strain = 1e-22, later.strain = 1e-19;
    Snapshot body = particle(false);
    body.m = {2};
    ConservationWatch watch(scene, body);
    watch.follow(start);
    watch.follow(later);
    CHECK_FALSE(watch.so_far().energy);
    later.kinetic = 1e-6, later.work = 1e-6;
    watch.follow(later);
    CHECK(watch.so_far().energy);
  }

  TEST_CASE("conservation: clamped, driven, loaded or damped bodies and gravity exchange momentum") {
    const Snapshot free = particle(false);
    Scene scene;
    scene.bodies.resize(2);
    CHECK_FALSE(exchanges_momentum(scene, free));
    CHECK(exchanges_momentum(scene, particle(true)));
    Scene driven = scene, loaded = scene, pulled = scene, damped = scene;
    driven.bodies[1].drives.resize(1);
    loaded.bodies[1].loads.resize(1);
    pulled.gravity[1] = [](double) { return -9.81; };
    damped.damping = 1;
    for (const Scene* other : {&driven, &loaded, &pulled, &damped}) CHECK(exchanges_momentum(*other, free));
    scene.walls.resize(1);
    CHECK_FALSE(exchanges_momentum(scene, free));
  }
}

}  // namespace of_this_file
