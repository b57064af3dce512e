#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "tests/engine/judge/lattices.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

TEST_SUITE("unit") {
  TEST_CASE("judge: energy above twice the initial energy is divergence, the worst verdict") {
    const Scene scene = one_body(2);
    Snapshot now = lattice(2, 6, 1);
    now.v[0] = std::sqrt(0.5), now.v[2] = -std::sqrt(0.5);
    now.p[1] = 2;
    Judge judge(scene, now, support, kept);
    now.p[1] = std::sqrt(2 * 4.49);
    observe(judge, now, scene, 1);
    CHECK(judge.verdict() == Verdict::stable);
    now.p[1] = std::sqrt(2 * 4.51);
    observe(judge, now, scene, 2);
    CHECK(judge.verdict() == Verdict::diverged);
    observe(judge, now, scene, 2.5);
    now.p[1] = 0;
    part(now, 2.5 * dp, 5 * dp);
    observe(judge, now, scene, 3);
    CHECK(judge.verdict() == Verdict::diverged);
    CHECK(judge.since() == std::map<Verdict, double>{{Verdict::fractured, 3.0}, {Verdict::diverged, 2.0}});
  }

  TEST_CASE(
      "judge: doubled kinetic energy, or with kept neighbours a lasting loss of strain energy, is divergence") {
    const Scene scene = one_body(2);
    Snapshot now = lattice(2, 6, 1);
    now.strain_energy.assign(now.size(), 0);
    const auto set = [&](double joule) { now.v[0] = std::sqrt(joule), now.v[2] = -std::sqrt(joule); };
    set(2);
    Judge judge(scene, now, support, searched);
    set(3.99), now.strain_energy[1] = -2;
    observe(judge, now, scene, 1);
    CHECK(judge.verdict() == Verdict::stable);
    set(4.01), now.strain_energy[1] = -2.01;
    observe(judge, now, scene, 2);
    CHECK(judge.verdict() == Verdict::diverged);
    now.strain_energy[1] = 0, set(2);
    Judge other(scene, now, support, kept);
    set(2.1), now.strain_energy[1] = -0.19;
    observe(other, now, scene, 1);
    CHECK(other.verdict() == Verdict::stable);
    set(1.5), now.strain_energy[1] = -0.21;  // possible if the law's energy has no minimum
    observe(other, now, scene, 2);
    CHECK(other.verdict() == Verdict::stable);  // a loss must last for two observations
    now.strain_energy[1] = -0.19;
    observe(other, now, scene, 3);
    now.strain_energy[1] = -0.21;
    observe(other, now, scene, 4);
    CHECK(other.verdict() == Verdict::stable);
    observe(other, now, scene, 5);
    CHECK(other.verdict() == Verdict::diverged);
  }

  TEST_CASE("judge: a body at rest on which nothing acts diverges from speeds of 1.5e-4 sound speeds") {
    const Scene scene = one_body(2);
    for (const double speed : {1e-9, 1.3e-4, 1.5e-4, 1.0}) {
      CAPTURE(speed);
      Snapshot now = lattice(2, 6, 1);
      Judge judge(scene, now, support, searched);
      for (std::size_t i = 0; i < now.size(); ++i) now.v[2 * i] = i % 2 ? speed : -speed;
      observe(judge, now, scene, 1);
      CHECK(judge.verdict() == (speed < 1.4e-4 ? Verdict::stable : Verdict::diverged));
    }
  }

  TEST_CASE("judge: the greatest external work so far counts as received energy") {
    const Scene scene = one_loaded_body();
    Snapshot now = lattice(2, 6, 1);
    Judge judge(scene, now, support, searched);
    now.v[0] = 1;
    now.work = 0.26;
    observe(judge, now, scene, 1);
    CHECK(judge.verdict() == Verdict::stable);
    now.work = -0.3;
    observe(judge, now, scene, 2);
    CHECK(judge.verdict() == Verdict::stable);
    now.v[0] = 1.03;
    observe(judge, now, scene, 3);
    CHECK(judge.since() == std::map<Verdict, double>{{Verdict::diverged, 3.0}});
  }

  TEST_CASE("judge: divergence does not depend on a common motion unless the body may meet a wall") {
    Scene scene = one_body(2);
    const auto verdict = [&](double common) {
      Snapshot now = lattice(2, 6, 1);
      for (std::size_t i = 0; i < now.size(); ++i) now.v[2 * i] = common;
      now.v[1] = 1;
      Judge judge(scene, now, support, searched);
      now.v[1] = 1.5;
      observe(judge, now, scene, 1);
      return judge.verdict();
    };
    for (const double common : {0.0, 3.0, -1e3}) CHECK(verdict(common) == Verdict::diverged);
    Wall wall;
    wall.normal = {0, 1, 0};
    wall.at = {0, -100, 0};
    scene.walls = {wall};
    for (const double common : {0.0, 3.0, -1e3}) CHECK(verdict(common) == Verdict::diverged);
    scene.walls[0].at[1] = -dp;  // the wall may turn the common motion
    CHECK(verdict(0) == Verdict::diverged);
    CHECK(verdict(3) == Verdict::stable);
  }

  TEST_CASE("judge: without kept neighbours excess strain energy is no divergence if almost nothing moves") {
    const Scene scene = one_loaded_body();
    for (const bool keeps : {false, true})
      for (const double speed : {0.1, 1.5}) {
        CAPTURE(keeps);
        CAPTURE(speed);
        Snapshot now = lattice(2, 6, 1);
        now.strain_energy.assign(now.size(), 0);
        Judge judge(scene, now, support, keeps);
        now.work = 1;
        now.strain_energy[2] = 1.9;
        now.v[1] = speed;
        observe(judge, now, scene, 1);
        CHECK((judge.verdict() == Verdict::diverged) == (speed > 1));
        now.strain_energy[2] = 2.1;
        observe(judge, now, scene, 2);
        CHECK((judge.verdict() == Verdict::diverged) == (keeps || speed > 1));
      }
  }

  TEST_CASE("judge: a position, velocity, density or stress that is not finite is divergence") {
    const Scene scene = one_body(2);
    const Snapshot start = lattice(2, 6, 1);
    const auto spoil = {&Snapshot::x, &Snapshot::v, &Snapshot::rho, &Snapshot::p, &Snapshot::s};
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
      for (const auto member : spoil) {
        if (member == &Snapshot::rho && std::isinf(bad)) continue;  // no solver reaches this state
        Judge judge(scene, start, support, searched);
        Snapshot now = start;
        now.p.assign(now.size(), 1);
        (now.*member)[3] = bad;
        observe(judge, now, scene, 4);
        CHECK(judge.since() == std::map<Verdict, double>{{Verdict::diverged, 4.0}});
      }
    }
  }
}

}  // namespace of_this_file
