#include <cmath>

#include <doctest/doctest.h>

#include "engine/diagnostics/indicators.hpp"
#include "engine/judge/verdict.hpp"
#include "engine/scene/shapes/box.hpp"
#include "tests/engine/judge/lattices.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

TEST_SUITE("unit") {
  TEST_CASE("verdict: names convert both ways, and verdicts are ordered from best to worst") {
    CHECK(name(Verdict::stable) == "stable");
    CHECK(name(Verdict::diverged) == "diverged");
    for (const Verdict each :
         {Verdict::stable, Verdict::hourglass, Verdict::penetrated, Verdict::fractured, Verdict::diverged}) {
      CHECK(find_verdict(name(each)) == each);
    }
    CHECK(name(Verdict::penetrated) == "penetrated");
    CHECK_FALSE(find_verdict("broken"));
    CHECK(Verdict::stable < Verdict::hourglass);
    CHECK(Verdict::hourglass < Verdict::penetrated);
    CHECK(Verdict::penetrated < Verdict::fractured);
    CHECK(Verdict::fractured < Verdict::diverged);
  }

  TEST_CASE("judge: a zigzag above the threshold is found, and smooth bending into a half circle is not") {
    const Scene scene = one_body(2);
    const Snapshot start = lattice(2, 20, 10);
    IndicatorGauge gauge(scene, start);
    const auto verdict = [&](auto place) {
      Snapshot now = start;
      for (std::size_t i = 0; i < now.size(); ++i) place(i, now.x0[2 * i], now.x0[2 * i + 1], &now.x[2 * i]);
      Judge judge(scene, start, support, searched);
      judge.observe(now, balance(now, scene), gauge(now));
      return judge.verdict();
    };
    for (const double amplitude : {0.025, 0.035}) {
      CAPTURE(amplitude);
      CHECK(verdict([&](std::size_t i, double, double, double* x) {
              x[1] += (i % 2 ? amplitude : -amplitude) * dp;
            }) == (amplitude > 0.03 ? Verdict::hourglass : Verdict::stable));
    }
    // half circle with its inner face compressed to a quarter
    CHECK(verdict([&](std::size_t, double x0, double y0, double* x) {
            const double radius = 2 * 1.9 / 3.14159265358979 / 2, angle = x0 / radius;
            x[0] = (radius + y0 - 0.45) * std::sin(angle);
            x[1] = (radius + y0 - 0.45) * std::cos(angle);
          }) == Verdict::stable);
  }

  TEST_CASE("judge: a strong zigzag in one patch of a large body is found, also beside another body") {
    const Scene scene = made_scene(2, dp, {unit_bulk(), unit_bulk()});
    constexpr std::size_t of_first = 60 * 30;
    for (const bool bystander : {false, true})
      for (const double amplitude : {0.12, 0.18}) {
        CAPTURE(bystander);
        CAPTURE(amplitude);
        Snapshot start = lattice(2, 60, bystander ? 60 : 30);
        for (std::size_t i = of_first; i < start.size(); ++i)
          start.body[i] = 1, start.x0[2 * i] = start.x[2 * i] += 100;
        Snapshot now = start;
        const auto from_centre = [&](std::size_t i) {
          return std::hypot(now.x0[2 * i] - 30 * dp, now.x0[2 * i + 1] - 15 * dp);
        };
        for (std::size_t i = 0; i < of_first; ++i)
          if (from_centre(i) < 4.5 * dp) now.x[2 * i + 1] += (i % 2 ? amplitude : -amplitude) * dp;
        const Readings readings = IndicatorGauge(scene, start)(now);
        Judge judge(scene, start, support, searched);
        judge.observe(now, balance(now, scene), readings);
        CHECK(judge.verdict() == (amplitude > 0.15 ? Verdict::hourglass : Verdict::stable));
        REQUIRE(readings[0].particle >= 0);
        CHECK(from_centre(static_cast<std::size_t>(readings[0].particle)) < 3 * dp);
      }
  }

  TEST_CASE(
      "judge: a soft joint of two columns between stiff halves may stretch far, and a crack in it is found") {
    Scene scene = one_body(2);
    scene.materials.push_back({.name = "stiff", .density = 1, .youngs_modulus = 30, .poisson_ratio = 0});
    // stretches of bonds in the joint, beside it, and in the halves
    const auto verdict = [&](double joint, double beside, double halves) {
      constexpr std::size_t columns = 16, soft = 7;
      Snapshot now = lattice(2, columns, 6);
      for (std::size_t i = 0; i < now.size(); ++i)
        now.material[i] = i % columns == soft || i % columns == soft + 1 ? 0 : 1;
      Judge judge(scene, now, support, kept);
      for (std::size_t i = 0; i < now.size(); ++i) {
        double x = 0;
        for (std::size_t k = 0; k < i % columns; ++k)
          x += dp * (k == soft ? joint : k + 1 == soft || k == soft + 1 ? beside : halves);
        now.x[2 * i] = x;
      }
      observe(judge, now, scene, 1);
      return judge.verdict();
    };
    CHECK(verdict(2.8, 1.99, 1.18) == Verdict::stable);
    CHECK(verdict(2.8, 1.02, 1.0) == Verdict::fractured);
  }

  TEST_CASE(
      "judge: rows bent to a radius of one spacing exceed the hourglass threshold, to a radius of two they do not") {
    const Scene scene = one_body(2);
    const auto reading = [&](int rows, double radius) {
      const Snapshot start = lattice(2, 40, rows);
      Snapshot now = start;
      for (std::size_t i = 0; i < now.size(); ++i) {
        const double angle = now.x0[2 * i] / radius, r = radius + now.x0[2 * i + 1] - 0.5 * (rows - 1) * dp;
        now.x[2 * i] = r * std::sin(angle), now.x[2 * i + 1] = r * std::cos(angle);
      }
      return IndicatorGauge(scene, start)(now)[0].share();
    };
    for (const int rows : {1, 2, 3}) {
      CAPTURE(rows);
      CHECK(reading(rows, dp) > hourglass_threshold);
      CHECK(reading(rows, 2 * dp) < 0.5 * hourglass_threshold);
      CHECK(reading(rows, 4 * dp) < 0.1 * hourglass_threshold);
    }
  }

  TEST_CASE("judge: a chain of particles breaks when a bond outgrows the support") {
    const Scene scene = one_body(2);
    Snapshot now = lattice(2, 6, 1);
    Judge judge(scene, now, support, searched);
    CHECK(judge.pieces() == 1);
    part(now, 2.5 * dp, 1.59 * dp);
    observe(judge, now, scene, 1);
    CHECK(judge.pieces() == 1);
    CHECK(judge.verdict() == Verdict::stable);
    CHECK(judge.since().empty());
    part(now, 2.5 * dp, 1.61 * dp);
    observe(judge, now, scene, 2);
    CHECK(judge.pieces() == 2);
    CHECK(judge.verdict() == Verdict::fractured);
    for (std::size_t i = 0; i < now.size(); ++i) now.x[2 * i] = 3 * now.x0[2 * i];
    observe(judge, now, scene, 3);
    CHECK(judge.pieces() == 6);
    CHECK(judge.since() == std::map<Verdict, double>{{Verdict::fractured, 2.0}});
  }

  TEST_CASE("judge: a bond is unbroken up to 2 dp even if the support is shorter") {
    const Scene scene = one_body(2);
    Snapshot now = lattice(2, 2, 1);
    Judge judge(scene, now, 1.2 * dp, searched);
    part(now, 0, 0.99 * dp);
    observe(judge, now, scene, 1);
    CHECK(judge.pieces() == 1);
    part(now, 0, 1.01 * dp);
    observe(judge, now, scene, 2);
    CHECK(judge.pieces() == 2);
  }

  TEST_CASE(
      "judge: in 3D bonds join neighbours along face diagonals, not along space diagonals or over two spacings") {
    const Scene scene = one_body(3);
    const Snapshot corner = made_snapshot(3, {{0, 0, 0}, {dp, dp, 0}, {-dp, 0, -dp}});
    CHECK(Judge(scene, corner, support, searched).pieces() == 1);
    CHECK(Judge(scene, lattice(3, 3, 3, 3), support, searched).pieces() == 1);
    CHECK(Judge(scene, made_snapshot(3, {{0, 0, 0}, {2 * dp, 0, 0}}), support, searched).pieces() == 2);
    CHECK(Judge(scene, made_snapshot(3, {{0, 0, 0}, {dp, dp, dp}}), support, searched).pieces() == 2);
  }

  TEST_CASE("judge: bonds reach 1.5 spacings and no further") {
    const Scene scene = one_body(2);
    CHECK(Judge(scene, made_snapshot(2, {{0, 0, 0}, {1.49 * dp, 0, 0}}), support, searched).pieces() == 1);
    CHECK(Judge(scene, made_snapshot(2, {{0, 0, 0}, {1.51 * dp, 0, 0}}), support, searched).pieces() == 2);
  }

  TEST_CASE("judge: the ends of a broken bond may be eight bonds apart, not nine") {
    const Scene scene = one_body(2);
    for (const int bonds : {8, 9}) {  // unbroken bonds of a ring that is opened and straightened
      const int n = bonds + 1;
      const double turn = 2 * 3.14159265358979 / n, radius = 0.5 * dp / std::sin(0.5 * turn);
      std::vector<Point> places;
      for (int k = 0; k < n; ++k)
        places.push_back({radius * std::cos(turn * k), radius * std::sin(turn * k), 0});
      Snapshot now = made_snapshot(2, places);
      Judge judge(scene, now, support, searched);
      for (int k = 0; k < n; ++k) now.x[2 * static_cast<std::size_t>(k)] = k * dp;
      for (int k = 0; k < n; ++k) now.x[2 * static_cast<std::size_t>(k) + 1] = 0;
      observe(judge, now, scene, 1);
      CHECK(judge.pieces() == 1);
      CHECK(judge.verdict() == (bonds == 9 ? Verdict::fractured : Verdict::stable));
    }
  }

  TEST_CASE("judge: a body cut in half is fractured, in 2D and 3D, wherever it lies") {
    for (const int dim : {2, 3}) {
      for (const double origin : {0.0, -7.77, 1234.5}) {
        CAPTURE(dim);
        CAPTURE(origin);
        const Scene scene = one_body(dim);
        Snapshot now = lattice(dim, 8, 5, dim == 3 ? 4 : 1);
        for (double& x : now.x0) x += origin;
        now.x = now.x0;
        Judge judge(scene, now, support, searched);
        CHECK(judge.pieces() == 1);
        part(now, origin + 3.5 * dp, 2 * dp);
        observe(judge, now, scene, 0.5);
        CHECK(judge.pieces() == 2);
        CHECK(judge.verdict() == Verdict::fractured);
      }
    }
  }

  TEST_CASE("judge: a cut that ends inside the body is a fracture if it is five particles deep") {
    const Scene scene = one_body(2);
    for (const int deep : {4, 5}) {
      Snapshot now = lattice(2, 10, 10);
      Judge judge(scene, now, support, searched);
      for (std::size_t i = 0; i < now.size(); ++i)
        if (now.x0[2 * i] > 4.5 * dp && now.x0[2 * i + 1] > (9.5 - deep) * dp) now.x[2 * i] += 2 * dp;
      observe(judge, now, scene, 1);
      CHECK(judge.pieces() == 1);
      CHECK(judge.verdict() == (deep == 5 ? Verdict::fractured : Verdict::stable));
    }
  }

  TEST_CASE("judge: with kept neighbours a body may stretch, and a crack in it is still found") {
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      const Scene scene = one_body(dim);
      const Snapshot start = lattice(dim, 16, 6, dim == 3 ? 4 : 1);
      const auto verdict = [&](bool keeps_neighbors, auto place) {
        Snapshot now = start;
        for (std::size_t i = 0; i < now.size(); ++i) place(&now.x[static_cast<std::size_t>(dim) * i]);
        Judge judge(scene, start, support, keeps_neighbors);
        observe(judge, now, scene, 1);
        return judge.verdict();
      };
      const auto drawn = [](double* x) { x[0] *= 3, x[1] *= 0.6; };
      CHECK(verdict(kept, drawn) == Verdict::stable);
      CHECK(verdict(searched, drawn) == Verdict::fractured);
      const auto ever_more = [](double* x) { x[0] = dp * (std::pow(1.4, x[0] / dp) - 1) / 0.4; };
      CHECK(verdict(kept, ever_more) == Verdict::stable);
      for (const double opened : {1.3, 1.8}) {
        const auto cracked = [=](double* x) {
          x[0] = 2 * x[0] + (x[0] > 7.5 * dp ? 2 * (opened - 1) * dp : 0);
        };
        CHECK(verdict(kept, cracked) == (opened > 1.5 ? Verdict::fractured : Verdict::stable));
      }
    }
    // at a ragged crack, initially collinear bonds may no longer be collinear
    const Scene flat = one_body(2);
    for (const bool ragged : {false, true}) {
      Snapshot now = lattice(2, 16, 6);
      Judge judge(flat, now, support, kept);
      for (std::size_t i = 0; i < now.size(); ++i) {
        const bool tip = ragged && std::abs(now.x0[2 * i + 1] - 2 * dp) < 0.1 * dp;
        now.x[2 * i] += now.x0[2 * i] > (tip ? 8.5 : 7.5) * dp ? 10 * dp : 0;
      }
      observe(judge, now, flat, 1);
      CHECK(judge.verdict() == Verdict::fractured);
      CHECK(judge.pieces() == 2);
    }
    const Scene scene = one_body(2);
    Snapshot two = lattice(2, 2, 1);
    Judge judge(scene, two, support, kept);
    part(two, 0, 1.61 * dp);
    observe(judge, two, scene, 1);
    CHECK(judge.verdict() == Verdict::fractured);
  }

  TEST_CASE("judge: bonds belong to the undisplaced layout") {
    const Scene scene = one_body(2);
    for (const bool cut : {false, true}) {
      Snapshot now = lattice(2, 10, 10);
      for (double& x : now.x) x *= 1.8;
      Judge judge(scene, now, support, kept);
      CHECK(judge.pieces() == 1);
      for (std::size_t i = 0; i < now.size(); ++i)
        if (cut && now.x0[2 * i] > 4.5 * dp) now.x[2 * i] += 4 * dp;
      observe(judge, now, scene, 1);
      CHECK(judge.verdict() == (cut ? Verdict::fractured : Verdict::stable));
    }
  }

  TEST_CASE(
      "judge: the share of bonds stretched beyond the method's law is recorded, and the time when it first exceeds 0") {
    Scene scene = made_scene(2, 0.001, {{"rubber", 1000, 1e6, 0.3}});
    scene.bodies[0].shapes = {Box{{0, 0, 0}, {0.008, 0.006, 0}}};
    Settings settings;
    settings.method = "oenog";
    const auto simulation = make_simulation(scene, settings);
    Judge judge(scene, *simulation);
    Snapshot now = simulation->snapshot();
    const auto draw_out = [&](double stretch, double time) {
      for (std::size_t i = 0; i < now.size(); ++i) now.x[2 * i] = stretch * now.x0[2 * i];
      observe(judge, now, scene, time);
    };
    draw_out(2.4, 1);
    CHECK(judge.beyond_law().share == 0);
    draw_out(2.6, 2);
    draw_out(1, 3);
    // 7 × 6 bonds along x; further 8 × 5 across and 2 × 7 × 5 diagonal bonds
    CHECK(judge.beyond_law().share == relative(42.0 / 152, 1e-12));
    CHECK(judge.beyond_law().since == 2);
    settings.method = "tl";
    CHECK(std::isinf(make_simulation(scene, settings)->lawful_stretch()));
  }

  TEST_CASE("judge: a ring that is cut once is fractured, although it remains one piece") {
    std::vector<Point> places;
    constexpr double turn = 6.283185307179586;
    for (int k = 0; k < 120; ++k)
      for (const double r : {19 * dp, 20 * dp})
        places.push_back({r * std::cos(turn * (k + 0.5) / 120), r * std::sin(turn * (k + 0.5) / 120), 0});
    const Scene scene = one_body(2);
    Snapshot now = made_snapshot(2, places);
    Judge judge(scene, now, support, searched);
    CHECK(judge.pieces() == 1);
    for (std::size_t i = 0; i < now.size(); ++i)
      if (now.x0[2 * i + 1] > 0) now.x[2 * i + 1] += 0.1 * (now.x0[2 * i] + 20 * dp);
    observe(judge, now, scene, 1);
    CHECK(judge.pieces() == 1);
    CHECK(judge.verdict() == Verdict::fractured);
  }

  TEST_CASE("judge: two bodies that touch at the start may part") {
    const Scene scene = made_scene(2, dp, {unit_bulk(), unit_bulk()});
    Snapshot now = lattice(2, 6, 4);
    for (std::size_t i = 0; i < now.size(); ++i) now.body[i] = now.x0[2 * i] > 2.5 * dp;
    Judge judge(scene, now, support, searched);
    CHECK(judge.pieces() == 2);
    part(now, 2.5 * dp, 5);
    observe(judge, now, scene, 1);
    CHECK(judge.pieces() == 2);
    CHECK(judge.verdict() == Verdict::stable);
  }

  TEST_CASE("judge: two parts of a body may move further apart, but a third part is a fracture") {
    const Scene scene = one_body(2);
    Snapshot now = lattice(2, 9, 2);
    part(now, 5.5 * dp, 3 * dp);
    now.x0 = now.x;
    Judge judge(scene, now, support, searched);
    CHECK(judge.pieces() == 2);
    part(now, 7 * dp, 4);
    observe(judge, now, scene, 1);
    CHECK(judge.verdict() == Verdict::stable);
    part(now, 1.5 * dp, 4);
    observe(judge, now, scene, 2);
    CHECK(judge.pieces() == 3);
    CHECK(judge.verdict() == Verdict::fractured);
  }

  TEST_CASE("judge: a fracture that heals stays a fracture") {
    const Scene scene = one_body(2);
    Snapshot now = lattice(2, 6, 2);
    Judge judge(scene, now, support, searched);
    for (const double time : {1.0, 3.0}) {
      part(now, 2.5 * dp, 3 * dp);
      observe(judge, now, scene, time);
      CHECK(judge.pieces() == 2);
      part(now, 2.5 * dp, 0);
      observe(judge, now, scene, time + 1);
      CHECK(judge.pieces() == 1);
    }
    CHECK(judge.verdict() == Verdict::fractured);
    CHECK(judge.since().at(Verdict::fractured) == 1);
  }
}

}  // namespace of_this_file
