#include <cmath>

#include <doctest/doctest.h>

#include "engine/judge/energies.hpp"
#include "tests/support/made_snapshot.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using test::made_scene;
using test::made_snapshot;
using test::relative;
using test::unit_bulk;

namespace {

constexpr double dp = 0.1, support = 2.6 * dp;

/// 4 × 4 particles of 1 kg; the lowest left ones are at `corners`.
struct Squares {
  Scene scene;
  Snapshot now;

  explicit Squares(const std::vector<Point>& corners) {
    scene = made_scene(2, dp, std::vector<Material>(corners.size(), unit_bulk()));
    std::vector<Point> places;
    for (const Point& corner : corners)
      for (int k = 0; k < 16; ++k) places.push_back({corner[0] + k % 4 * dp, corner[1] + k / 4 * dp, 0});
    now = made_snapshot(2, places);
    for (std::size_t i = 0; i < now.size(); ++i) now.body[i] = now.material[i] = static_cast<int>(i / 16);
  }
  EnergyTest test() const { return {scene, now, support, true}; }
  /// Common speed along x and alternating speeds along y, m/s.
  void set_speeds(int body, double common, double against) {
    for (std::size_t i = 0; i < now.size(); ++i)
      if (now.body[i] == body) now.v[2 * i] = common, now.v[2 * i + 1] = i % 2 ? against : -against;
  }
  void set_turn(int body, double rate) {
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now.body[i] != body) continue;
      const std::size_t first = 16 * static_cast<std::size_t>(body);
      now.v[2 * i] = -rate * (now.x[2 * i + 1] - now.x[2 * first + 1] - 1.5 * dp);
      now.v[2 * i + 1] = rate * (now.x[2 * i] - now.x[2 * first] - 1.5 * dp);
    }
  }
  void move(int body, double by) {
    for (std::size_t i = 0; i < now.size(); ++i)
      if (now.body[i] == body) now.x[2 * i] += by;
  }
  bool diverges(EnergyTest& test, double time) {
    now.time = time;
    return test.diverges(now);
  }
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("energies: neither a distant fast body nor a common speed changes the verdict on a body") {
    for (const bool bystander : {false, true})
      for (const double common : {0.0, 3.0, -100.0})
        for (const double grown : {1.4, 1.5}) {
          CAPTURE(bystander);
          CAPTURE(common);
          CAPTURE(grown);
          Squares squares(bystander ? std::vector<Point>{{}, {0, 5, 0}} : std::vector<Point>{{}});
          squares.set_speeds(0, common, 0.1);
          if (bystander) squares.set_speeds(1, common + 7, 0.1);
          EnergyTest test = squares.test();
          squares.set_speeds(0, common, grown * 0.1);
          CHECK(squares.diverges(test, 1e-3) == (grown > 1.45));
        }
  }

  TEST_CASE("energies: bodies that may have met are judged by their common energy, wherever they go later") {
    for (const double apart : {2 * dp, 2.0}) {
      CAPTURE(apart);
      Squares squares({{}, {3 * dp + apart, 0, 0}});
      squares.set_speeds(0, 1, 0);
      EnergyTest test = squares.test();
      squares.set_speeds(0, 0.5, 0.4);  // zigzags of 1.3 J; the common energy was 4 J
      CHECK(squares.diverges(test, 0.01) == (apart > 1));
      squares.move(1, 100);
      CHECK(squares.diverges(test, 0.02) == (apart > 1));
    }
  }

  TEST_CASE("energies: a body that passes another one between two observations may have met it") {
    Squares squares({{}, {2, 0, 0}});
    squares.set_speeds(0, 50, 0);
    EnergyTest test = squares.test();
    squares.move(0, 4);
    squares.set_speeds(0, 49, 3);
    CHECK_FALSE(squares.diverges(test, 0.08));
  }

  TEST_CASE("energies: the gain of a body is recorded once the energy exceeds 1.1 times the initial one") {
    Squares squares({{}, {0, 5, 0}});
    squares.set_speeds(0, 0, 0.1);
    squares.set_speeds(1, 0, 1);
    EnergyTest test = squares.test();
    squares.set_speeds(0, 0, 0.1 * std::sqrt(1.09));
    squares.diverges(test, 1);
    CHECK(test.gain().greatest == 0);
    squares.set_speeds(0, 0, 0.1 * std::sqrt(1.3));
    CHECK_FALSE(squares.diverges(test, 2));
    squares.set_speeds(0, 0, 0.1 * std::sqrt(1.2));
    squares.diverges(test, 3);
    CHECK(test.gain().greatest == relative(1.3, 1e-12));
    CHECK(test.gain().since == 2);
  }

  TEST_CASE("energies: a body of one particle does not turn by itself") {
    Squares squares(std::vector<Point>{{}});
    squares.now = made_snapshot(2, {{0.3, 0.7, 0}});
    squares.now.v = {1.1, -0.3};
    EnergyTest test = squares.test();
    for (const double time : {0.01, 0.02, 0.03}) {
      squares.now.x[0] += 0.011, squares.now.x[1] -= 0.003;
      CHECK_FALSE(squares.diverges(test, time));
    }
    CHECK(test.turn().greatest == 0);
  }

  TEST_CASE("energies: a change of angular momentum is recorded for a free body and not for a clamped one") {
    for (const bool clamped : {false, true})
      for (const double common : {0.0, 10.0}) {
        CAPTURE(clamped);
        CAPTURE(common);
        Squares squares({{}, {0, 5, 0}});
        if (clamped) squares.scene.bodies[0].clamped = [](const Point&) { return 1.0; };
        squares.set_turn(0, 1);
        for (std::size_t i = 0; i < 16; ++i) squares.now.v[2 * i] += common;
        EnergyTest test = squares.test();
        squares.set_turn(0, 1.005);
        for (std::size_t i = 0; i < 16; ++i) squares.now.v[2 * i] += common;
        squares.diverges(test, 0.01);
        CHECK(test.turn().greatest == 0);
        squares.set_turn(0, 0.95);
        for (std::size_t i = 0; i < 16; ++i) squares.now.v[2 * i] += common;
        squares.diverges(test, 0.02);
        CHECK(test.turn().greatest == (clamped ? 0 : relative(0.05 / 1.005, 1e-9)));
        CHECK(test.turn().since == (clamped ? 0 : 0.02));
      }
  }
}

}  // namespace of_this_file
