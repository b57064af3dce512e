// Snapshots: made when asked for, without a trace in the run; where they store the components of a stress.

#include <cstring>
#include <string>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

using namespace taut;
using namespace taut::test;

namespace {

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

TEST_SUITE("determinism") {
  TEST_CASE("snapshots: to take some on the way changes nothing at the end") {
    for (const Scene& scene : {small_collision(), small_clamped_plate()}) {
      for (const MethodInfo& method : methods()) {
        CAPTURE(scene.name);
        CAPTURE(std::string(method.name));
        const auto seldom = make_simulation(scene, with_method(std::string(method.name)));
        const auto often = make_simulation(scene, with_method(std::string(method.name)));
        for (int k = 0; k < 40; ++k) {
          make_steps(*seldom, 1);
          make_steps(*often, 1);
          CHECK(often->snapshot().step == often->steps());
          CHECK(often->snapshot().time == often->time());
        }
        const Snapshot &a = seldom->snapshot(), &b = often->snapshot();
        CHECK(a.step == b.step);
        for (const auto field : {&Snapshot::x, &Snapshot::v, &Snapshot::rho, &Snapshot::p, &Snapshot::s,
                                 &Snapshot::strain_energy})
          CHECK(same(a.*field, b.*field));
        CHECK(seldom->save() == often->save());
      }
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("snapshots: a run that breaks off keeps the last one") {
    const auto simulation = make_simulation(small_collision(), with_method("enog"));
    make_steps(*simulation, 1);
    const Snapshot before = simulation->snapshot();
    make_steps(*simulation, 3);
    Settings wild = with_method("enog");
    wild.step = 1;  // s
    const auto broken = make_simulation(small_collision(), wild);
    const Snapshot start = broken->snapshot();
    CHECK_THROWS_AS(broken->advance_to(100), NumericalError);
    CHECK(broken->snapshot().step == start.step);
    CHECK(same(broken->snapshot().x, start.x));
    CHECK(simulation->snapshot().step == before.step + 3);
  }

  TEST_CASE("snapshots: vectors and stresses of a particle, in the plane and in space") {
    Snapshot plane;
    plane.resize(2, 2);
    plane.x = {1, 2, 3, 4};
    plane.p = {0, 5};
    plane.set_deviator(1, {.xx = 1, .yy = 2, .zz = -3, .xy = 7});
    CHECK(plane.position(1) == Point{3, 4, 0});
    CHECK(plane.s == std::vector<double>{0, 0, 0, 0, 1, 7, 2, -3});  // xx, xy, yy, zz
    const StressTensor flat = plane.stress(1);
    CHECK((flat.xx == -4 && flat.yy == -3 && flat.zz == -8 && flat.xy == 7 && flat.xz == 0 && flat.yz == 0));

    Snapshot space;
    space.resize(3, 1);
    space.v = {1, 2, 3};
    space.set_deviator(0, {1, 2, 3, 4, 5, 6});
    CHECK(space.velocity(0) == Point{1, 2, 3});
    CHECK(space.s == std::vector<double>{1, 4, 5, 2, 6, 3});  // xx, xy, xz, yy, yz, zz
    const StressTensor solid = space.deviator(0);
    CHECK(
        (solid.xx == 1 && solid.yy == 2 && solid.zz == 3 && solid.xy == 4 && solid.xz == 5 && solid.yz == 6));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("snapshots: a particle is drawn as wide as the square of its volume at the start") {
    const Scene scene = small_collision();
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const Snapshot now = state_after(3, scene, with_method(std::string(method.name)));
      for (std::size_t i = 0; i < now.size(); ++i)
        REQUIRE(now.diameter[i] * now.diameter[i] * ring_rubber().density ==
                doctest::Approx(now.m[i]).scale(0).epsilon(1e-12));
    }
  }
}
