#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/lines.hpp"
#include "engine/error.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

Scene two_blocks(double gap, double speed) {
  const double dp = 0.001;
  Scene scene;
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  scene.bodies.resize(2);
  scene.bodies[0].name = "still";
  scene.bodies[0].shapes = {Box{{-0.006, -0.003, 0}, {0, 0.003, 0}}};
  scene.bodies[1].name = "flying";
  scene.bodies[1].shapes = {Box{{gap, -0.003, 0}, {gap + 0.004, 0.003, 0}}};
  scene.bodies[1].velocity[0] = constant(-speed);
  return scene;
}

Probe at_point(Probe::Kind kind, int body, const Point& at, int axis) {
  Probe probe = make_probe("", kind, {body});
  probe.at = at;
  probe.axis = axis;
  return probe;
}

Scene block(const Point& half) {
  Scene scene;
  scene.dim = 3;
  scene.spacing = 0.001;
  scene.materials = {ring_rubber()};
  Body body;
  body.name = "block";
  body.shapes = {Box{{-half[0], -half[1], -half[2]}, half}};
  scene.bodies = {body};
  return scene;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("probes: points on a face and inside follow a body in free flight") {
    const double speed = 3;
    Scene scene = two_blocks(0.01, speed);
    const Point corner = {0.014, 0.003, 0}, inside = {0.0117, -0.0004, 0};
    scene.probes = {
        at_point(Probe::Kind::displacement, 1, corner, 0), at_point(Probe::Kind::position, 1, inside, 0),
        at_point(Probe::Kind::position, 1, inside, 1),     at_point(Probe::Kind::distance, 1, corner, 0),
        at_point(Probe::Kind::mean_velocity, 1, {}, 0),    at_point(Probe::Kind::mean_velocity, 0, {}, 0)};
    scene.probes[3].to = inside;
    const auto simulation = make_simulation(scene, with_method("enog"));
    make_steps(*simulation, 40);
    const Series& series = simulation->series();
    REQUIRE(series.value.size() == scene.probes.size());
    CHECK(series.time.size() == 41);
    const double distance = std::hypot(corner[0] - inside[0], corner[1] - inside[1]);
    for (std::size_t k = 0; k < series.time.size(); ++k) {
      const double way = -speed * series.time[k];
      CHECK(series.value[0][k] == Approx(way).scale(1e-6).epsilon(1e-9));
      CHECK(series.value[1][k] == relative(inside[0] + way));
      CHECK(series.value[2][k] == relative(inside[1]));
      CHECK(series.value[3][k] == relative(distance));
      CHECK(series.value[4][k] == relative(-speed));
      CHECK(series.value[5][k] == 0);
    }
    CHECK(series.time.back() * speed > 0.0001);
  }

  TEST_CASE(
      "probes: a point on a face belongs to the body, but a point in a hole or beside a face does not") {
    Scene scene = colliding_rings();
    Probe probe;
    probe.name = "p";
    probe.kind = Probe::Kind::displacement;
    probe.bodies = {0};
    const auto takes = [&](const Point& at, double spacing) {
      scene.spacing = spacing;
      probe.at = at;
      scene.probes = {probe};
      try {
        make_simulation(scene, with_method("oenog"));
        return true;
      } catch (const SceneError& error) {
        CHECK(std::string(error.what()).find("the point of the probe 'p' is outside its body") == 0);
        return false;
      }
    };
    Body& body = scene.bodies[0];
    scene.bodies.resize(1);
    body.velocity = {};
    body.shapes = {Box{{0, 0, 0}, {0.02, 0.02, 0}}};
    body.without = {Box{{0.008, 0.008, 0}, {0.012, 0.012, 0}}};
    for (const double x : {0.0, 0.008, 0.02}) CHECK(takes({x, 0, 0}, 0.001));
    CHECK(takes({0.008, 0.008, 0}, 0.001));
    CHECK_FALSE(takes({0.01, 0.01, 0}, 0.001));  // 2 spacings from the faces of the hole
    CHECK_FALSE(takes({-0.0011, 0.01, 0}, 0.001));
  }

  TEST_CASE("probes: a point follows a linear field") {
    Scene scene = rotating_plate(1e-6);
    const Point at = {0.0093, 0.01, 0};
    scene.probes = {at_point(Probe::Kind::displacement, 0, at, 0),
                    at_point(Probe::Kind::displacement, 0, at, 1)};
    const double omega = scene.bodies[0].velocity[1]({1, 0, 0});
    const auto simulation = make_simulation(scene, with_method("enog"));
    make_steps(*simulation, 1);
    const double angle = omega * simulation->time();
    CHECK(angle > 0);
    CHECK(simulation->series().value[0][1] == relative(-angle * at[1], 1e-4));
    CHECK(simulation->series().value[1][1] == relative(angle * at[0], 1e-4));
  }

  TEST_CASE("probes: a corner follows a linear field and starts in place to round-off") {
    Scene scene = rotating_plate(1e-6);
    const double half = 0.01;
    for (const double x : {-half, half})
      for (const double y : {-half, half})
        for (const int axis : {0, 1})
          scene.probes.push_back(at_point(Probe::Kind::position, 0, {x, y, 0}, axis));
    const auto simulation = make_simulation(scene, with_method("oenog"));
    for (std::size_t k = 0; k < scene.probes.size(); ++k)
      CHECK(simulation->series().value[k][0] == relative(scene.probes[k].at[scene.probes[k].axis], 1e-13));
    make_steps(*simulation, 1);
    const double angle = scene.bodies[0].velocity[1]({1, 0, 0}) * simulation->time();
    REQUIRE(angle > 1e-8);
    for (std::size_t k = 0; k < scene.probes.size(); k += 2) {
      const Point& at = scene.probes[k].at;
      CHECK(simulation->series().value[k][1] - at[0] == relative(-angle * at[1], 1e-4));
      CHECK(simulation->series().value[k + 1][1] - at[1] == relative(angle * at[0], 1e-4));
    }
  }

  TEST_CASE("probes: the gap of two approaching faces starts at their distance and closes") {
    const double speed = 10, start = 0.0012, dp = 0.001;
    Scene scene = two_blocks(start, speed);
    scene.probes = {make_probe("gap", Probe::Kind::gap, {0, 1})};
    const auto simulation = make_simulation(scene, with_method("enog"));
    make_steps(*simulation, 200);
    const Series& series = simulation->series();
    CHECK(series.value[0][0] == relative(start));
    CHECK((start - series.value[0][1]) / series.time[1] == relative(speed, 0.01));
    double least = start;
    for (const double gap : series.value[0]) least = std::min(least, gap);
    CHECK(least < 0.5 * start);
    CHECK(least > -0.5 * dp);
  }

  TEST_CASE("probes: the gap of two particles is the distance of their surfaces") {
    Scene scene = two_blocks(0.0012, 10);
    const double dp = scene.spacing;
    scene.bodies[0].shapes = {Box{{0, 0, 0}, {dp, dp, 0}}};
    scene.bodies[1].shapes = {Box{{1.6 * dp, 0, 0}, {2.6 * dp, dp, 0}}};
    scene.probes = {make_probe("gap", Probe::Kind::gap, {0, 1})};
    scene.contact = ContactLaw::penalty;
    for (const char* method : {"enog", "oenog"}) {
      CAPTURE(method);
      CHECK(make_simulation(scene, with_method(method))->series().value[0][0] == relative(0.6 * dp));
    }
  }

  TEST_CASE("probes: the gap of distant bodies is the support minus one spacing") {
    Scene scene = two_blocks(0.01, 0);
    scene.probes = {make_probe("gap", Probe::Kind::gap, {0, 1})};
    const auto simulation = make_simulation(scene, with_method("enog"));
    CHECK(simulation->series().value[0][0] == relative(simulation->support() - scene.spacing));
    CHECK(simulation->support() == relative(2 * 1.3 * scene.spacing));
  }

  TEST_CASE(
      "probes: the mirror asymmetry of two rings is round-off, or twice the shift of the mirror plane") {
    Scene scene = colliding_rings(0.06, 0.0025);
    Probe mirror = make_probe("mirror", Probe::Kind::mirror_asymmetry, {0, 1});
    scene.probes = {mirror};
    CHECK(make_simulation(scene, with_method("enog"))->series().value[0][0] < 1e-16);
    scene.probes[0].at[0] = 0.0005;
    CHECK(make_simulation(scene, with_method("enog"))->series().value[0][0] == relative(0.001));
    scene.bodies[1].shapes = {Ring{{0.045, 0, 0}, 0.02, 0.04}};
    CHECK_THROWS_WITH_AS(make_simulation(scene, with_method("enog")),
                         doctest::Contains("not images of each other"), SceneError);
  }

  TEST_CASE("probes: the mirror asymmetry of two bodies follows them while they are apart") {
    Scene scene = colliding_rings(0.06, 0.0025);
    for (Expression& component : scene.bodies[1].velocity) component = {};
    scene.probes = {make_probe("mirror", Probe::Kind::mirror_asymmetry, {0, 1})};
    for (const char* method : {"enog", "tl"}) {
      CAPTURE(method);
      const auto simulation = make_simulation(scene, with_method(method));
      const double x = simulation->snapshot().x[0];
      make_steps(*simulation, 96);
      CHECK(simulation->series().value[0].back() > 0.6 * std::abs(simulation->snapshot().x[0] - x));
    }
  }

  TEST_CASE("probes: a mass centre moves with its body") {
    const double speed = 3;
    Scene scene = two_blocks(0.01, speed);
    scene.probes = {at_point(Probe::Kind::mean_position, 1, {}, 0),
                    at_point(Probe::Kind::mean_position, 1, {}, 1)};
    const auto simulation = make_simulation(scene, with_method("enog"));
    make_steps(*simulation, 40);
    const Series& series = simulation->series();
    CHECK(series.value[0].back() == relative(0.012 - speed * series.time.back()));
    CHECK(std::abs(series.value[1].back()) < 1e-15);
  }

  TEST_CASE("probes: the mass centre of a body of two materials depends on both densities") {
    for (const char* method : {"oenog", "tl"}) {
      CAPTURE(method);
      Scene scene = block({0.004, 0.002, 0.002});
      Material heavy = scene.materials[0];
      heavy.name = "heavy", heavy.density *= 9;
      scene.materials.push_back(heavy);
      const auto right = [](const Point& x) { return x[0] > 0 ? 1.0 : 0.0; };
      scene.bodies[0].parts = {{1, right}};
      scene.bodies[0].velocity[0] = right;
      scene.probes = {at_point(Probe::Kind::mean_position, 0, {}, 0),
                      at_point(Probe::Kind::mean_velocity, 0, {}, 0)};
      const auto simulation = make_simulation(scene, with_method(method));
      make_steps(*simulation, 20);
      const Series& series = simulation->series();
      // in 3D, oenog places more mass near faces
      CHECK(series.value[0].front() == relative(0.8 * 0.002, 6e-3));
      CHECK(series.value[1].front() == relative(0.9));
      CHECK(series.value[1].back() == relative(0.9, 1e-9));
    }
  }

  TEST_CASE(
      "probes: stress beside an interface belongs to its own side, and particles beyond a slot are ignored") {
    constexpr double dp = 0.001, strain = 1e-3;
    Scene scene;
    scene.spacing = dp;
    scene.materials = {ring_rubber(), ring_rubber()};
    scene.materials[1].name = "stiff", scene.materials[1].youngs_modulus *= 5;
    Body body;
    body.shapes = {Box{{0, 0, 0}, {11 * dp, 20 * dp, 0}}};
    body.without = {Box{{5 * dp, 2 * dp, 0}, {6 * dp, 21 * dp, 0}}};
    body.parts = {{1, [](const Point& x) { return x[0] < 2 * dp ? 1.0 : 0.0; }}};
    body.displacement[1] = [](const Point& x) { return x[0] < 5.5 * dp ? strain * x[1] : 0.0; };
    scene.bodies = {body};
    const Point beside[] = {{1.5 * dp, 10.5 * dp, 0},
                            {2.5 * dp, 10.5 * dp, 0},
                            {4.5 * dp, 10.5 * dp, 0},
                            {6.5 * dp, 10.5 * dp, 0}};
    for (const Point& at : beside) {
      scene.probes.push_back(at_point(Probe::Kind::stress, 0, at, 1));
      scene.probes.back().part = StressPart::yy;
      scene.probes.push_back(at_point(Probe::Kind::displacement, 0, at, 1));
    }
    SampleLine line;
    line.name = "across", line.field = "stress_yy", line.points = 2, line.times = {0};
    line.from = beside[0], line.to = beside[1];
    scene.lines = {line};
    for (const char* method : {"oenog", "tl"}) {
      CAPTURE(method);
      const auto simulation = make_simulation(scene, with_method(method));
      const Snapshot& now = simulation->snapshot();
      const auto value = [&](std::size_t probe) { return simulation->series().value[probe][0]; };
      for (std::size_t k = 0; k < std::size(beside); ++k) {
        std::size_t i = 0;
        while (std::hypot(now.initial(i)[0] - beside[k][0], now.initial(i)[1] - beside[k][1]) > 0.1 * dp) ++i;
        CHECK(std::abs(value(2 * k) - now.stress(i).yy) < 1e-9 * 1e4);
        CHECK(std::abs(value(2 * k + 1) - (k < 3 ? strain * beside[k][1] : 0)) < 1e-9 * strain * dp);
      }
      CHECK(value(0) == relative(5 * value(2), 0.01));
      CHECK(value(4) == relative(value(2), 0.01));
      CHECK(std::abs(value(6)) < 1e-6 * value(2));
      LineRecorder lines(scene, now, simulation->support());
      lines.sample(now);
      CHECK(lines.samples()[0][0].value[0] == relative(value(0)));
      CHECK(lines.samples()[0][0].value[1] == relative(value(2)));
    }
  }

  TEST_CASE("probes and lines: a stress beside a driven region belongs to the free side, as beside a clamp") {
    constexpr double strain = 1e-3, edge = 0.006;
    const auto shown = [&](const char* method, bool driven) {
      Scene scene = block({0.01, 0.005, 0});
      scene.dim = 2;
      Body& body = scene.bodies[0];
      const Expression grip = [](const Point& x) { return x[0] > edge ? 1.0 : 0.0; };
      if (driven)
        body.drives = {{.where = grip, .velocity = {}, .until = {}}};
      else
        body.clamped = grip;
      body.displacement[0] = [](const Point& x) { return strain * (x[0] < edge ? x[0] : edge); };
      scene.probes = {at_point(Probe::Kind::stress, 0, {edge, 0.001, 0}, 0)};
      SampleLine line;
      line.name = "along", line.field = "stress_xx", line.points = 3, line.times = {0};
      line.from = {0, 0.001, 0}, line.to = {edge, 0.001, 0};
      scene.lines = {line};
      const auto simulation = make_simulation(scene, with_method(method));
      LineRecorder lines(scene, simulation->snapshot(), simulation->support());
      lines.sample(simulation->snapshot());
      const std::vector<double>& on_line = lines.samples()[0][0].value;
      CHECK(on_line[2] == relative(simulation->series().value[0][0]));
      return on_line;
    };
    for (const char* method : {"pf-jst", "tl"}) {
      CAPTURE(method);
      const std::vector<double> clamped = shown(method, false), driven = shown(method, true);
      for (std::size_t k = 0; k < clamped.size(); ++k) CHECK(driven[k] == relative(clamped[k]));
      CHECK(driven[0] > 0);
    }
    Scene scene = two_blocks(0.01, 0);
    scene.bodies[1].drives = {{.where = constant(1), .velocity = {}, .until = {}}};
    scene.probes = {at_point(Probe::Kind::stress, 1, {0.012, 0, 0}, 0)};
    CHECK(std::abs(make_simulation(scene, with_method("tl"))->series().value[0][0]) < 1e-6);
  }

  TEST_CASE("probes: a point beside an interface moves with its own side of the kink") {
    Scene scene = block({0.01, 0.005, 0});
    scene.dim = 2;
    scene.materials = {ring_rubber(), ring_rubber()};
    scene.materials[1].name = "soft", scene.materials[1].youngs_modulus /= 5;
    scene.bodies[0].parts = {{1, [](const Point& x) { return x[0] > 0 ? 1.0 : 0.0; }}};
    const auto u = [](double x) { return x > 0 ? 5e-3 * x : 1e-3 * x; };
    scene.bodies[0].displacement[0] = [=](const Point& x) { return u(x[0]); };
    const std::vector<double> along = {-0.0011, -0.0003, 0, 0.0003, 0.0011};
    for (const double x : along)
      scene.probes.push_back(at_point(Probe::Kind::displacement, 0, {x, 0.0007, 0}, 0));
    for (const char* method : {"oenog", "tl"}) {
      CAPTURE(method);
      const auto simulation = make_simulation(scene, with_method(method));
      for (std::size_t k = 0; k < along.size(); ++k)
        CHECK(std::abs(simulation->series().value[k][0] - u(along[k])) < 1e-12 * scene.spacing);
    }
  }

  TEST_CASE("probes: if a body has particles on its faces, its gap to another is 0 when pair forces begin") {
    for (const bool first : {true, false}) {
      Scene scene = two_blocks(0.0014, 2);
      scene.contact = ContactLaw::penalty;
      scene.bodies[0].on_boundary = first, scene.bodies[1].on_boundary = true;
      scene.probes = {make_probe("gap", Probe::Kind::gap, {0, 1}),
                      make_probe("push", Probe::Kind::contact_force, {0, 1})};
      const auto simulation = make_simulation(scene, with_method("tl"));
      simulation->advance_to(0.0006);
      const auto& gap = simulation->series().value[0];
      const auto& push = simulation->series().value[1];
      // cell-centred particles lie half a spacing aside and behind the face
      const double apart = first ? 0.0014 : std::hypot(0.0019, 0.0005);
      CHECK(gap[0] == relative(apart - scene.spacing));
      std::size_t k = 0;
      while (k + 1 < push.size() && push[k] == 0) ++k;
      REQUIRE(push[k] != 0);
      CHECK(gap[k - 1] > -0.005 * scene.spacing);  // forces are means over steps
      CHECK(gap[k + 1] < 0);
    }
    Scene far = two_blocks(0.01, 0);
    for (Body& body : far.bodies) body.on_boundary = true;
    far.probes = {make_probe("gap", Probe::Kind::gap, {0, 1})};
    const auto simulation = make_simulation(far, with_method("enog"));
    CHECK(simulation->series().value[0][0] == relative(simulation->support() - far.spacing));
  }

  TEST_CASE(
      "probes: points of a rotated body with particles on its faces have the values of the unrotated body") {
    const auto last_values = [](double angle) {
      constexpr double pitch = 0.25;
      const Rotation turn{{0, 0, 1}, {0.3, -0.2, 0}, angle}, back{{0, 0, 1}, {0.3, -0.2, 0}, -angle};
      const Rotation about_origin{{0, 0, 1}, {}, angle};
      Scene scene;
      scene.name = "turned";
      scene.spacing = pitch;
      scene.materials = {plate_elastic()};
      Body body;
      body.name = "body";
      body.shapes = {Box{{0, 0, 0}, {8 * pitch, 3.6 * pitch, 0}}};
      body.on_boundary = true;
      body.rotation = turn;
      body.clamped = [=](const Point& x) { return rotated(back, x)[0] < 1.2 * pitch ? 1.0 : 0.0; };
      for (std::size_t k = 0; k < 2; ++k)
        body.velocity[k] = [=](const Point& x) {
          const double along = rotated(back, x)[0];
          return rotated(about_origin, {0, 0.1 * along * along, 0})[k];
        };
      scene.bodies = {body};
      const auto add = [&](Probe::Kind kind, const Point& at) {
        scene.probes.push_back(make_probe("probe", kind));
        scene.probes.back().at = rotated(turn, at);
      };
      add(Probe::Kind::displacement, {pitch, 0.9 * pitch, 0});
      add(Probe::Kind::displacement, {8 * pitch, 3.6 * pitch, 0});
      add(Probe::Kind::displacement, {8 * pitch, 3.6 * pitch, 0});
      scene.probes.back().axis = 1;
      add(Probe::Kind::stress, {4.3 * pitch, 3.6 * pitch, 0});
      scene.probes.back().part = StressPart::von_mises;
      const auto simulation = make_simulation(scene, with_method("tl"));
      make_steps(*simulation, 40);
      std::vector<double> values;
      for (const std::vector<double>& series : simulation->series().value) values.push_back(series.back());
      const Point corner = rotated({{0, 0, 1}, {}, -angle}, {values[1], values[2], 0});
      return std::vector{values[0], corner[0], corner[1], values[3]};
    };
    const std::vector<double> straight = last_values(0);
    CHECK(straight[0] == 0);
    CHECK(straight[2] > 0.01);
    CHECK(straight[3] > 0);
    for (const double angle : {90.0, 30.0}) {
      CAPTURE(angle);
      const std::vector<double> turned = last_values(angle);
      CHECK(std::abs(turned[0]) < 1e-12);
      for (std::size_t k = 1; k < straight.size(); ++k) CHECK(turned[k] == relative(straight[k], 1e-9));
    }
  }

  TEST_CASE("probes: the velocity of a material point and the extent of a body are exact") {
    const double rate = 50;
    Scene scene = block({0.005, 0.003, 0.002});
    scene.bodies[0].on_boundary = true;
    scene.bodies[0].velocity[1] = [=](const Point& x) { return rate * x[1] - 0.5; };
    scene.probes = {at_point(Probe::Kind::velocity, 0, {0.001, 0.003, 0}, 1),
                    at_point(Probe::Kind::velocity, 0, {0.0014, -0.0013, 0.0002}, 1),
                    at_point(Probe::Kind::greatest_position, 0, {}, 1),
                    at_point(Probe::Kind::greatest_position, 0, {}, 0)};
    const auto simulation = make_simulation(scene, with_method("tl"));
    const Series& series = simulation->series();
    CHECK(series.value[0][0] == relative(rate * 0.003 - 0.5));
    CHECK(series.value[1][0] == relative(-rate * 0.0013 - 0.5));
    CHECK(series.value[2][0] == relative(0.003));
    CHECK(series.value[3][0] == relative(0.005));
    make_steps(*simulation, 3);
    CHECK(series.value[2].back() < 0.003);
  }

  TEST_CASE(
      "probes: mirror asymmetry is 0 for a symmetric body, else the distance of a particle from its mirror image") {
    Scene scene = block({0.005, 0.003, 0.002});
    scene.probes = {make_probe("x", Probe::Kind::mirror_asymmetry, {0, 0}),
                    make_probe("y", Probe::Kind::mirror_asymmetry, {0, 0})};
    scene.probes[1].axis = 1;
    scene.bodies[0].velocity[0] = [](const Point& x) { return 2 * x[0]; };
    scene.bodies[0].velocity[1] = [](const Point& x) { return x[1] + 0.001; };
    const auto simulation = make_simulation(scene, with_method("tl"));
    make_steps(*simulation, 32);
    CHECK(simulation->series().value[0][0] < 1e-15);
    CHECK(simulation->series().value[0].back() < 1e-14);
    CHECK(simulation->series().value[1][0] < 1e-15);
    CHECK(simulation->series().value[1].back() == relative(0.002 * simulation->time(), 1e-6));
    scene.probes[0].at[0] = 0.0007;
    CHECK_THROWS_AS(make_simulation(scene, with_method("tl")), SceneError);
  }

  TEST_CASE("probes: in 3D the turn of a point about any axis counts whole turns with their sign") {
    const Point axis{2.0 / 3, -1.0 / 3, 2.0 / 3}, at{0.003, 0.004, -0.002};
    for (const double omega : {200.0, -200.0}) {
      CAPTURE(omega);
      Scene scene = block({0.004, 0.004, 0.004});
      for (std::size_t k = 0; k < 3; ++k)
        scene.bodies[0].velocity[k] = [=](const Point& x) {
          return omega * (axis[(k + 1) % 3] * x[(k + 2) % 3] - axis[(k + 2) % 3] * x[(k + 1) % 3]);
        };
      Probe turn = make_probe("turn", Probe::Kind::turn);
      turn.at = at;
      turn.turns_about = axis;
      scene.probes = {turn, turn};
      scene.probes[1].turns_about = {0, 0, 1};
      const auto simulation = make_simulation(scene, with_method("tl"));
      simulation->advance_to(0.05);
      const Series& series = simulation->series();
      CHECK(std::abs(series.value[0].front()) < 1e-15);
      CHECK(series.value[0].back() == relative(omega * series.time.back(), 1e-3));
      CHECK(std::abs(series.value[1].back() - omega * series.time.back()) > 0.1);
    }
  }

  TEST_CASE("probes: in 2D a turn is about z") {
    Scene scene = rotating_plate(0.01);
    Probe turn = make_probe("turn", Probe::Kind::turn);
    turn.at = {0.01, 0.005, 0};
    scene.probes = {turn};
    const double omega = scene.bodies[0].velocity[1]({1, 0, 0});
    const auto simulation = make_simulation(scene, with_method("oenog"));
    simulation->advance_to(7 / omega);
    CHECK(simulation->series().value[0].back() == relative(omega * simulation->time(), 1e-3));
  }
}

}  // namespace of_this_file
