#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "engine/core/archive.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/judge/penetration.hpp"
#include "engine/judge/verdict.hpp"
#include "tests/support/made_snapshot.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;
using test::made_scene;
using test::made_snapshot;
using test::unit_bulk;

namespace {

constexpr double dp = 0.1;

void add_rows(std::vector<Point>& places, int columns, int rows, const Point& low) {
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) places.push_back({low[0] + i * dp, low[1] + j * dp, 0});
}

Snapshot two_blocks() {
  std::vector<Point> places;
  add_rows(places, 20, 8, {0, -7 * dp, 0});
  const std::size_t first = places.size();
  add_rows(places, 8, 6, {6 * dp, 10 * dp, 0});
  Snapshot now = made_snapshot(2, places);
  for (std::size_t i = first; i < now.size(); ++i) now.body[i] = 1;
  return now;
}

void put(Snapshot& now, double right, double up) {
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now.body[i] == 0) continue;
    now.x[2 * i] = now.x0[2 * i] + right;
    now.x[2 * i + 1] = now.x0[2 * i + 1] - 10 * dp + up;
  }
}

/// Strip folded double; the turn has radius r.
Snapshot hairpin(double r) {
  std::vector<Point> places;
  add_rows(places, 60, 4, {0, -1.5 * dp, 0});
  Snapshot now = made_snapshot(2, places);
  const double begin = 28 * dp, end = begin + std::numbers::pi * r;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double s = now.x0[2 * i], y = now.x0[2 * i + 1];
    double* x = &now.x[2 * i];
    if (s > end) {
      x[0] = begin - (s - end), x[1] = 2 * r - y;
    } else if (s > begin) {
      const double angle = (s - begin) / r;
      x[0] = begin + (r - y) * std::sin(angle), x[1] = r - (r - y) * std::cos(angle);
    }
  }
  return now;
}

Snapshot two_cubes() {
  std::vector<Point> places;
  for (int k = 0; k < 4; ++k) add_rows(places, 9, 9, {0, 0, 0});
  for (int k = 0; k < 4; ++k) add_rows(places, 5, 5, {2 * dp, 2 * dp, 0});
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i][2] =
        i < 4 * 81 ? -dp * static_cast<double>(i / 81) : dp * (10 + static_cast<double>((i - 4 * 81) / 25));
  Snapshot now = made_snapshot(3, places);
  for (std::size_t i = 4 * 81; i < now.size(); ++i) now.body[i] = 1;
  return now;
}

void put_cube(Snapshot& now, double right, double up) {
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now.body[i] == 0) continue;
    now.x[3 * i] = now.x0[3 * i] + right;
    now.x[3 * i + 1] = now.x0[3 * i + 1] + right;
    now.x[3 * i + 2] = now.x0[3 * i + 2] - 10 * dp + up;
  }
}

void turn_all(Snapshot& now, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (std::size_t i = 0; i < now.size(); ++i) {
    double* x = &now.x[3 * i];
    const double y = c * x[1] - s * x[2], z = s * x[1] + c * x[2];
    const double first = c * x[0] - s * y;
    x[1] = s * x[0] + c * y, x[0] = first, x[2] = z;
  }
}

Snapshot folded_sheet(double r) {
  const Snapshot strip = hairpin(r);
  std::vector<Point> places, initial;
  for (int k = 0; k < 5; ++k)
    for (std::size_t i = 0; i < strip.size(); ++i) {
      places.push_back({strip.x[2 * i], strip.x[2 * i + 1], k * dp});
      initial.push_back({strip.x0[2 * i], strip.x0[2 * i + 1], k * dp});
    }
  Snapshot now = made_snapshot(3, initial);
  now.x = made_snapshot(3, places).x;
  return now;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE(
      "penetration: the widest gap is the greatest angle between neighbouring directions, 2π for fewer than two") {
    const auto gap = [](std::vector<double> directions) { return widest_gap(directions) / std::numbers::pi; };
    CHECK(gap({}) == 2);
    CHECK(gap({1}) == 2);
    CHECK(gap({0.5, 0.5 - std::numbers::pi}) == Approx(1));
    CHECK(gap({3, -3}) == Approx(6 / std::numbers::pi));
    CHECK(gap({-2, 0, 2}) == Approx(2 - 4 / std::numbers::pi));
  }

  TEST_CASE("penetration: faces may touch, interlock by one layer or dent each other without penetration") {
    Snapshot now = two_blocks();
    Penetration penetration(now, dp);
    CHECK(penetration(now) == 0);
    for (const double right : {0.0, 0.25 * dp, 0.5 * dp})
      for (const double up : {dp, 0.7 * dp, 0.3 * dp, 0.0}) {
        CAPTURE(right);
        CAPTURE(up);
        put(now, right, up);
        CHECK(penetration(now) == 0);
      }
    put(now, 0, 0);
    for (std::size_t i = 0; i < now.size(); ++i) {
      double* x = &now.x[2 * i];
      if (now.body[i] == 0) x[0] = 9.5 * dp + 1.4 * (now.x0[2 * i] - 9.5 * dp);
      x[1] += (now.body[i] == 0 ? 0 : 0.5 * dp) + 0.5 * (x[0] - 9.5 * dp) * (x[0] - 9.5 * dp);
    }
    CHECK(penetration(now) == 0);
  }

  TEST_CASE(
      "penetration: a row of particles between two bodies that it only touches does not penetrate them") {
    std::vector<Point> places;
    add_rows(places, 12, 13, {0, -6 * dp, 0});
    Snapshot now = made_snapshot(2, places);
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double y = now.x0[2 * i + 1];
      now.body[i] = y < -0.5 * dp ? 0 : y < 0.5 * dp ? 1 : 2;
    }
    CHECK(Penetration(now, dp)(now) == 0);
    Penetration penetration(now, dp);
    for (std::size_t i = 0; i < now.size(); ++i)
      if (now.body[i] == 1) now.x[2 * i + 1] += 1.5 * dp;
    CHECK(penetration(now) > 0);
  }

  TEST_CASE("penetration: a particle penetrates a body from 0.29 spacings behind the body's outermost row") {
    const Snapshot start = two_blocks();
    const auto inside = [&](double right, double up) {
      Snapshot now = start;
      put(now, right, up);
      return Penetration(start, dp)(now);
    };
    const double depth = 0.5 * dp / std::tan(std::numbers::pi / 3);
    CHECK(inside(0.5 * dp, -0.99 * depth) == 0);
    CHECK(inside(0.5 * dp, -1.01 * depth) > 0);
    CHECK(inside(0.5 * dp, -2 * dp) > 0);
    CHECK(inside(0.1 * dp, -4 * dp) > 0);
    CHECK(inside(0, -0.99 * depth) == 0);
    CHECK(inside(0, -1.01 * depth) > 0);
    CHECK(inside(30 * dp, -2 * dp) == 0);
  }

  TEST_CASE("penetration: a body folded into itself penetrates, one folded onto itself does not") {
    const Snapshot start = hairpin(1e9);
    Penetration penetration(start, dp);
    CHECK(penetration(start) == 0);
    CHECK(penetration(hairpin(2.5 * dp)) == 0);
    CHECK(penetration(hairpin(2.1 * dp)) == 0);
    CHECK(penetration(hairpin(1.2 * dp)) > 0);
  }

  TEST_CASE("penetration: a body that is strained and rotated does not penetrate itself") {
    const Snapshot start = hairpin(1e9);
    Penetration penetration(start, dp);
    for (const double stretch : {0.4, 0.6, 1.0, 1.7})
      for (const double angle : {0.0, 0.7}) {
        CAPTURE(stretch);
        Snapshot now = start;
        for (std::size_t i = 0; i < now.size(); ++i) {
          const double x = stretch * now.x0[2 * i], y = 0.8 * now.x0[2 * i + 1];
          now.x[2 * i] = std::cos(angle) * x - std::sin(angle) * y;
          now.x[2 * i + 1] = std::sin(angle) * x + std::cos(angle) * y;
        }
        CHECK(penetration(now) == 0);
      }
  }

  TEST_CASE("penetration: the result does not depend on when lists were built") {
    const Snapshot start = two_blocks();
    Penetration followed(start, dp);
    Snapshot now = start;
    int found = 0;
    for (int step = 0; step <= 600; ++step) {
      put(now, 0.03 * dp * std::sin(0.1 * step), (10 - 0.02 * step) * dp);
      for (std::size_t i = 0; i < now.size(); ++i) {
        if (now.body[i] == 0) now.x[2 * i] = (1 + 0.0004 * step) * now.x0[2 * i];
        now.x[2 * i + 1] = (now.body[i] == 0 ? now.x0[2 * i + 1] : now.x[2 * i + 1]) - step * dp;
      }
      const int inside = followed(now);
      REQUIRE(inside == Penetration(start, dp)(now));
      found += inside > 0;
    }
    CHECK(found > 50);
    CHECK(found < 200);
  }

  TEST_CASE("penetration in 3D: faces that touch, rotated or not, or dent each other are no penetration") {
    const Snapshot start = two_cubes();
    Penetration penetration(start, dp);
    CHECK(penetration(start) == 0);
    for (const double turn : {0.0, 0.3, 0.7})
      for (const double right : {0.0, 0.25 * dp, 0.5 * dp})
        for (const double up : {dp, 0.7 * dp, 0.3 * dp, 0.0}) {
          CAPTURE(turn);
          CAPTURE(right);
          CAPTURE(up);
          Snapshot now = start;
          put_cube(now, right, up);
          turn_all(now, turn);
          CHECK(penetration(now) == 0);
          for (std::size_t i = 0; i < now.size(); ++i) {
            const Point X = start.initial(i);
            now.x[3 * i + 2] += ((X[0] - 0.4) * (X[0] - 0.4) + (X[1] - 0.4) * (X[1] - 0.4)) / (20 * dp);
          }
          if (turn == 0 && up > 0) CHECK(penetration(now) == 0);
        }
  }

  TEST_CASE("penetration in 3D: penetration begins at a depth from 0.3 to 0.5 spacings") {
    const Snapshot start = two_cubes();
    const auto inside = [&](double right, double up, double turn = 0) {
      Snapshot now = start;
      put_cube(now, right, up);
      turn_all(now, turn);
      return Penetration(start, dp)(now);
    };
    CHECK(inside(0.5 * dp, -0.3 * dp) == 0);
    CHECK(inside(0.5 * dp, -0.5 * dp) > 0);
    CHECK(inside(0, -0.3 * dp) == 0);
    CHECK(inside(0, -0.5 * dp) > 0);
    CHECK(inside(0.5 * dp, -2 * dp) > 0);
    CHECK(inside(0.1 * dp, -3 * dp) > 0);
    CHECK(inside(0.1 * dp, -3 * dp, 0.5) > 0);
    CHECK(inside(30 * dp, -2 * dp) == 0);
  }

  TEST_CASE("penetration in 3D: a sheet folded into itself penetrates, one folded onto itself does not") {
    const Snapshot start = folded_sheet(1e9);
    Penetration penetration(start, dp);
    CHECK(penetration(start) == 0);
    CHECK(penetration(folded_sheet(2.1 * dp)) == 0);
    CHECK(penetration(folded_sheet(1.2 * dp)) > 0);
  }

  TEST_CASE("judge: the time of the first penetration counts, and a checkpoint keeps it") {
    const Scene scene = made_scene(2, dp, {unit_bulk(), unit_bulk()});
    const Snapshot start = two_blocks();
    Snapshot now = start;
    const auto observe = [&](Judge& judge, double time, double up) {
      now.time = time;
      put(now, 0, up);
      judge.observe(now, balance(now, scene));
    };
    Judge judge(scene, start, 2.6 * dp, /*keeps_neighbors*/ false);
    observe(judge, 1, dp);
    CHECK(judge.verdict() == Verdict::stable);

    Saver saver;
    saver(judge);
    const std::string before = saver.take();
    Judge resumed(scene, start, 2.6 * dp, false);
    Loader from_before(before);
    from_before(resumed);
    for (Judge* each : {&judge, &resumed}) {
      observe(*each, 2, -1.5 * dp);
      observe(*each, 3, -2.5 * dp);
      observe(*each, 4, dp);
      CHECK(each->verdict() == Verdict::penetrated);
      CHECK(each->since() == std::map<Verdict, double>{{Verdict::penetrated, 2.0}});
    }
    saver(judge);
    const std::string after = saver.take();
    Judge late(scene, start, 2.6 * dp, false);
    Loader from_after(after);
    from_after(late);
    CHECK(late.since() == judge.since());
    CHECK(late.verdict() == Verdict::penetrated);
  }
}

}  // namespace of_this_file
