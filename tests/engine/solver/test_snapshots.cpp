
#include <cmath>
#include <cstring>
#include <functional>
#include <string>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/error.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// `at` returns x at t and v at t − lag; `lag` in s.
struct Path {
  std::function<Point(double)> x, v;
  double lag = 0;

  Snapshot at(double t) const {
    Snapshot now;
    now.resize(2, 1);
    now.time = t;
    now.m = {3};
    for (const std::size_t k : {0, 1}) now.x[k] = x(t)[k], now.v[k] = v(t - lag)[k];
    return now;
  }
  /// Errors of the interpolated x and v.
  std::pair<double, double> errors(double dt) const {
    const double t = 0.4 + 0.2 * dt;
    const Snapshot shown = blend(at(0.4), at(0.4 + dt), t), exact = at(t);
    return {std::hypot(shown.x[0] - exact.x[0], shown.x[1] - exact.x[1]),
            std::hypot(shown.v[0] - exact.v[0], shown.v[1] - exact.v[1])};
  }
};

double greatest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

double difference(const Snapshot& a, const Snapshot& b, std::vector<double> Snapshot::*field) {
  std::vector<double> d = a.*field;
  for (std::size_t k = 0; k < d.size(); ++k) d[k] -= (b.*field)[k];
  return greatest(d) / greatest(a.*field);
}

}  // namespace

TEST_SUITE("determinism") {
  TEST_CASE("snapshots: a run can stop one step before a time and continue to the same state") {
    for (const Scene& scene : {small_collision(), small_clamped_plate()}) {
      for (const MethodInfo& method : methods()) {
        CAPTURE(scene.name);
        CAPTURE(std::string(method.name));
        const auto straight = make_simulation(scene, with_method(std::string(method.name)));
        make_steps(*straight, 30);
        const auto shown = make_simulation(scene, with_method(std::string(method.name)));
        for (int k = 1; k <= 7; ++k) {
          const double t = straight->time() * (k / 7.0);
          shown->advance(t, t);
          CHECK(shown->time() < t);
          const long steps = shown->steps();
          shown->advance_to(t);
          CHECK(shown->time() >= t);
          CHECK(shown->steps() == steps + 1);
        }
        CHECK(shown->save() == straight->save());
      }
    }
  }

  TEST_CASE("snapshots: runs whose steps differ by round-off have the same interpolated state") {
    const Scene scene = small_collision();
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      Settings settings = with_method(std::string(method.name));
      const auto first = make_simulation(scene, settings);
      make_steps(*first, 1);
      settings.step = first->time();
      const auto exact = make_simulation(scene, settings);
      make_steps(*exact, 12);
      settings.step *= 1 - 1e-12;  // step 12 ends just before exact->time()
      const auto shorter = make_simulation(scene, settings);
      const Snapshot shown = state_at(exact->time(), *shorter);
      CHECK(shown.time == exact->time());
      CHECK(shown.step == exact->steps() + 1);
      for (const auto field : {&Snapshot::x, &Snapshot::v, &Snapshot::rho, &Snapshot::p, &Snapshot::s})
        CHECK(difference(exact->snapshot(), shown, field) < 1e-8);
      CHECK(difference(exact->snapshot(), shorter->snapshot(), &Snapshot::p) > 1e-4);
    }
  }

  TEST_CASE(
      "snapshots: motion() returns the positions, velocities and energies of snapshot() to the last bit") {
    for (const Scene& scene :
         {small_collision(), small_clamped_plate(), small_solid_collision(), small_clamped_block()}) {
      for (const MethodInfo& method : methods()) {
        CAPTURE(scene.name);
        CAPTURE(std::string(method.name));
        const auto simulation = make_simulation(scene, with_method(std::string(method.name)));
        make_steps(*simulation, 20);
        const Snapshot motion = simulation->motion(), &all = simulation->snapshot();
        for (const auto field : {&Snapshot::x, &Snapshot::v, &Snapshot::m, &Snapshot::strain_energy})
          CHECK(same(motion.*field, all.*field));
        const Balance a = balance(motion, scene), b = balance(all, scene);
        CHECK(b.strain > 0);
        CHECK(a.strain == b.strain);
        CHECK(a.kinetic == b.kinetic);
        CHECK(a.work == b.work);
      }
    }
  }

  TEST_CASE("snapshots: snapshots during a run do not alter its end") {
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

TEST_SUITE("convergence") {
  TEST_CASE(
      "blend: free flight is exact, and errors of a rotation are of third order in x and second order in v") {
    const Path flight{[](double t) {
                        return Point{1 + 2 * t, 5 - 4.905 * t * t, 0};
                      },
                      [](double t) {
                        return Point{2, -9.81 * t, 0};
                      }};
    CHECK(flight.errors(0.1).first < 1e-15);
    CHECK(flight.errors(0.1).second < 1e-14);
    for (const double lag : {0.0, 0.5}) {  // 0.5: velocities at mid-step
      CAPTURE(lag);
      const auto turn = [&](double dt) {
        return Path{[](double t) {
                      return Point{std::cos(t), std::sin(t), 0};
                    },
                    [](double t) {
                      return Point{-std::sin(t), std::cos(t), 0};
                    },
                    lag * dt}
            .errors(dt);
      };
      const auto [x, v] = turn(0.02);
      const auto [finer_x, finer_v] = turn(0.01);
      CHECK(x / finer_x == relative(8, 0.02));
      CHECK(v / finer_v == relative(4, 0.02));
      // θ (1 − θ) (1 − 2θ)/12 dt³ at θ = 0.2, less the error from the lag of v
      CHECK(x == relative(std::abs(0.096 / 12 - lag * 0.16 / 2) * 8e-6, 0.02));
    }
  }

  TEST_CASE("blend: in a rotation the loss of angular momentum is of second order in the angle") {
    const Path turn{[](double t) {
                      return Point{std::cos(t), std::sin(t), 0};
                    },
                    [](double t) {
                      return Point{-std::sin(t), std::cos(t), 0};
                    }};
    constexpr double angle = 0.1;
    for (const double share : {0.2, 0.5, 0.9}) {
      const Snapshot now = blend(turn.at(0), turn.at(angle), share * angle);
      const double L = now.x[0] * now.v[1] - now.x[1] * now.v[0];
      CHECK(1 - L == relative(0.5 * share * (1 - share) * angle * angle, 0.02));
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE(
      "blend: state and energies are linear in time, and step, body and clamping are from the later snapshot") {
    Snapshot before;
    before.resize(2, 1);
    before.time = 1, before.step = 6;
    before.rho = {1000}, before.p = {8}, before.s = {1, 2, 3, 4}, before.strain_energy = {2};
    before.contact_energy = 4, before.work = 6, before.damped = 8;
    before.of_walls = {{1, 0, 0}, {0, 0, 2}};
    Snapshot after = before;
    after.time = 3, after.step = 7;
    after.rho = {1400}, after.p = {0}, after.s = {5, 2, 3, 0}, after.strain_energy = {6};
    after.contact_energy = 0, after.work = 7, after.damped = 10;
    after.of_walls = {{5, 0, 0}, {0, 0, 0}};
    after.body = {3}, after.clamped = {1};
    const Snapshot now = blend(before, after, 1.5);
    CHECK((now.time == 1.5 && now.step == 7));
    CHECK((now.rho[0] == 1100 && now.p[0] == 6 && now.strain_energy[0] == 3));
    CHECK(now.s == std::vector<double>{2, 2, 3, 3});
    CHECK((now.contact_energy == 3 && now.work == 6.25 && now.damped == 8.5));
    CHECK((now.of_walls.linear[0] == 2 && now.of_walls.angular[2] == 1.5));
    CHECK((now.body[0] == 3 && now.clamped[0] == 1));
    CHECK(same(blend(before, after, 3).s, after.s));
    CHECK(same(blend(before, after, 1).s, before.s));
  }

  TEST_CASE("snapshots: after a failed step the snapshot is the last state before the failure") {
    const auto simulation = make_simulation(small_collision(), with_method("enog"));
    make_steps(*simulation, 1);
    const Snapshot before = simulation->snapshot();
    make_steps(*simulation, 3);
    Settings wild = with_method("enog");
    wild.step = 1;
    const auto broken = make_simulation(small_collision(), wild);
    const Snapshot start = broken->snapshot();
    CHECK_THROWS_AS(broken->advance_to(100), NumericalError);
    CHECK(broken->snapshot().step == start.step);
    CHECK(same(broken->snapshot().x, start.x));
    CHECK(simulation->snapshot().step == before.step + 3);
  }

  TEST_CASE("snapshots: vectors and stresses are read from the right array elements in 2D and 3D") {
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
  TEST_CASE("snapshots: the square of a particle's diameter is its initial volume in 2D") {
    const Scene scene = small_collision();
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const Snapshot now = state_after(3, scene, with_method(std::string(method.name)));
      for (std::size_t i = 0; i < now.size(); ++i)
        REQUIRE(now.diameter[i] * now.diameter[i] * ring_rubber().density ==
                Approx(now.m[i]).scale(0).epsilon(1e-12));
    }
  }
}

}  // namespace of_this_file
