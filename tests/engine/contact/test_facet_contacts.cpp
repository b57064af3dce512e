#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/error.hpp"
#include "engine/scene/shapes/given_particles.hpp"
#include "engine/terms/surface_contact.hpp"
#include "tests/support/closing_arms.hpp"
#include "tests/support/pressed.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.001;
constexpr double arm = 0.02;
using V = Vec<double, 3>;
constexpr Point direction{0.64, 0.48, 0.6};

double modulus() { return ring_rubber().bulk_modulus() + 4.0 / 3 * ring_rubber().shear_modulus(); }

Scene scene_of(const std::vector<Shape>& shapes) { return scene_of_shapes(shapes, 3, dp); }

Pressed<3> two_balls(double depth, double r = 0.006) {
  const double apart = 2 * r - depth;
  return Pressed<3>(scene_of(
      {Disc{{0, 0, 0}, r}, Disc{{apart * direction[0], apart * direction[1], apart * direction[2]}, r}}));
}

double length(const V& v) { return std::sqrt(dot(v, v)); }

}  // namespace

TEST_SUITE("term") {
  TEST_CASE("surface contact: in 3D weights sum to one and slopes are the derivatives of their functions") {
    const double radius = 1.5 * dp, step = 1e-7;
    double sum = 0;
    constexpr int rings = 1000;
    for (int k = 0; k < rings; ++k) {
      const double l2 = (k + 0.5) / rings * radius * radius;
      sum += lateral_weight(l2, radius) * std::numbers::pi * radius * radius / rings;
    }
    CHECK(sum == Approx(1).epsilon(1e-6));
    CHECK(lateral_weight(radius * radius, radius) == 0);
    for (const double at : {0.1, 0.4, 0.8}) {
      const double l2 = at * radius * radius, d = step * radius * radius;
      CHECK((lateral_weight(l2 + d, radius) - lateral_weight(l2 - d, radius)) / (2 * d) ==
            Approx(lateral_slope(l2, radius)).epsilon(1e-6));
      CHECK((covered_share(at + step) - covered_share(at - step)) / (2 * step) ==
            Approx(covered_slope(at)).epsilon(1e-6));
    }
    CHECK(covered_share(0.5) == Approx(0.5));
    CHECK(covered_share(0.15) == 0);
    CHECK(covered_share(0.85) == Approx(1));
    CHECK(covered_slope(0.1) == 0);
    for (const double at : {0.1, 0.5, 1.1}) {
      const double depth = at * dp, d = step * dp;
      CHECK((hard_energy(depth + d, 1, 1, dp) - hard_energy(depth - d, 1, 1, dp)) / (2 * d) ==
            Approx(hard_force(depth, 1, 1, dp)).epsilon(1e-6));
      CHECK((hard_force(depth + d, 1, 1, dp) - hard_force(depth - d, 1, 1, dp)) / (2 * d) ==
            Approx(0.5 * hardening(depth, 1, dp)).epsilon(1e-6));
      CHECK((lateral_radius(d - depth, dp) - lateral_radius(-d - depth, dp)) / (2 * d) ==
            Approx(lateral_radius_slope(-depth, dp)).epsilon(1e-6));
      const double l2 = 0.5 * at * radius * radius, change = step * radius;
      CHECK((lateral_weight(l2, radius + change) - lateral_weight(l2, radius - change)) / (2 * change) ==
            Approx(lateral_slope_in_radius(l2, radius)).epsilon(1e-6));
    }
    for (const double cover : {0.3, 0.6, 0.8})
      CHECK((covered_slope(cover + step) - covered_slope(cover - step)) / (2 * step) ==
            Approx(covered_second_derivative(cover)).epsilon(1e-6));
    CHECK(hardening(dp, 0.09, dp) == 1);
    for (const double at : {-0.97, -0.8, 0.5, 0.75, 0.9}) {
      const double p = at * dp, d = step * dp;
      CHECK((near_share(p + d, dp) - near_share(p - d, dp)) / (2 * d) ==
            Approx(near_slope(p, dp)).epsilon(1e-6));
    }
    CHECK(near_share(0.6 * dp, dp) == 1);
    CHECK(near_share(dp, dp) == 0);
    CHECK((surface_stiffness(2e7, 3e7 + 1, 2, dp) - surface_stiffness(2e7, 3e7 - 1, 2, dp)) / 2 ==
          Approx(surface_stiffness_slope(2e7, 3e7, 2, dp)).epsilon(1e-6));
    CHECK(projected_share(-1) == 1);
    for (const double cosine : {-0.9, -0.4, -0.1})
      CHECK((projected_share(cosine + step) - projected_share(cosine - step)) / (2 * step) ==
            Approx(projected_slope(cosine)));
    for (const double cosine : {-0.9, -0.4, -0.1})
      CHECK((facing_share(cosine + step) - facing_share(cosine - step)) / (2 * step) ==
            Approx(facing_slope(cosine)));
  }
}

TEST_SUITE("analytic") {
  TEST_CASE(
      "contact of faces: in 3D the force between two blocks is nearly k times their volume of overlap") {
    const double depth = 0.1 * dp, area = 64 * dp * dp, k = modulus() / (2 * dp);
    Pressed<3> blocks(
        scene_of({Box{{-0.006, 0, 0}, {0, 0.008, 0.008}}, Box{{0, 0, 0}, {0.006, 0.008, 0.008}}}));
    CHECK(std::abs(blocks.force_on(1)[0]) < 1e-9 * k * depth * area);
    blocks.shift(1, {-depth, 0, 0});
    const V force = blocks.force_on(1);
    CHECK(force[0] == Approx(1.02 * k * depth * area).epsilon(0.03));
    CHECK(std::hypot(force[1], force[2]) < 1e-9 * force[0]);
    CHECK(blocks.energy() == Approx(1.01 / 1.02 * 0.5 * depth * force[0]).epsilon(1e-3));
    CHECK(blocks.gap() == Approx(-depth).epsilon(1e-9));
    CHECK(length(blocks.between(1, 0) - force) < 1e-9 * force[0]);
    CHECK(length(blocks.between(0, 1) + force) < 1e-9 * force[0]);
  }

  TEST_CASE("contact of faces: in 3D a step beside a body exerts no force on it before they overlap") {
    for (const double step : {1.0, 1.3, 2.0}) {
      CAPTURE(step);
      Scene scene = scene_of({Box{{0, 0, -4 * dp}, {12 * dp, 12 * dp, 0}},
                              Box{{0.1 * dp, 3 * dp, 0}, {6.1 * dp, 9 * dp, 6 * dp}}});
      scene.bodies[0].shapes.push_back(Box{{-4 * dp, 0, -4 * dp}, {0, 12 * dp, step * dp}});
      Pressed<3> blocks(scene);
      const double k = modulus() / (2 * dp), energy_at_tenth = 0.25 * k * 0.01 * dp * dp * 36 * dp * dp;
      CHECK(length(blocks.force_on(1)) < 1e-6 * k * 0.1 * dp * 36 * dp * dp);
      CHECK(std::abs(blocks.energy()) < 1e-6 * energy_at_tenth);
    }
  }

  TEST_CASE(
      "contact of faces: in 3D a wall presses a body like the body's mirror image, and its impulse is recorded") {
    const double depth = 0.1 * dp, area = 36 * dp * dp, k = modulus() / (2 * dp);
    Scene scene = scene_of({Box{{-0.008, 0, 0}, {0, 0.006, 0.006}}});
    scene.walls = {{"wall", {0, 0, 0}, {-1, 0, 0}}};
    Pressed<3> block(scene);
    CHECK(std::abs(block.force_on(0)[0]) < 1e-9 * k * depth * area);
    block.shift(0, {0.5 * depth, 0, 0});
    const V force = block.force_on(0);
    CHECK(force[0] == Approx(-k * depth * area).epsilon(1e-9));
    CHECK(block.energy() == Approx(0.25 * k * depth * depth * area).epsilon(1e-9));
    CHECK(length(block.of_wall(0) - force) < 1e-9 * length(force));
    CHECK(block.of_walls().linear[0] == Approx(force[0]).epsilon(1e-9));
    CHECK(block.of_walls().angular[2] == Approx(-0.003 * force[0]).epsilon(1e-9));
  }

  TEST_CASE("contact of faces: in 3D balls exert no force before they meet, and no force is attractive") {
    for (const double depth : {-0.3e-3, -0.1e-3, 0.1e-3, 0.3e-3}) {
      CAPTURE(depth);
      Pressed<3> balls = two_balls(depth);
      const V force = balls.force_on(1);
      CHECK(std::abs(balls.gap() + depth) < 0.02 * dp);
      const double away = force[0] * direction[0] + force[1] * direction[1] + force[2] * direction[2];
      if (depth < 0)
        CHECK((length(force) == 0 && balls.energy() == 0));
      else
        CHECK(away > 2 * modulus() * depth * depth);
      CHECK(std::sqrt(std::max(0.0, dot(force, force) - away * away)) <= 0.1 * away);
    }
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("contact of faces: in 3D forces are −∂E/∂x, and their sum and moment vanish") {
    const Box low{{-0.004, 0, 0}, {0, 0.006, 0.006}};
    Scene on_edge = scene_of({low, Box{{0, 0.003, 0.0017}, {0.004, 0.007, 0.0057}}});
    on_edge.bodies[1].rotation = Rotation{{0, 0, 1}, {0, 0.003, 0}, -25};
    const Scene rims = scene_of({low, Box{{0, 0.0023, -0.0017}, {0.004, 0.0083, 0.0043}}});
    Scene hard_in_part = rims;
    hard_in_part.materials.push_back(ring_rubber());
    hard_in_part.materials[1].youngs_modulus *= 10;
    Part& hard = hard_in_part.bodies[1].parts.emplace_back();
    hard.where = [](const Point& x) { return x[1] > 0.0045; };
    hard.material = 1;
    struct Case {
      std::string name;
      Pressed<3> bodies;
      double depth;
    };
    Case cases[] = {{"balls", two_balls(0.4 * dp, 0.004), 0},
                    {"rims", Pressed<3>(rims), 0.3},
                    {"rims, deep", Pressed<3>(rims), 0.85},
                    {"on edge", Pressed<3>(on_edge), 0.6},
                    {"two materials", Pressed<3>(hard_in_part), 0.3}};
    for (auto& [name, bodies, depth] : cases) {
      CAPTURE(name);
      bodies.shift(1, {-depth * dp, 0, 0});
      for (V& x : bodies.s.x) {
        const Point at{x[0], x[1], x[2]}, across{x[1], x[2], x[0]};
        x += 0.03 * dp * V{shake(at, 7 * dp), shake(across, 5 * dp), shake({x[2], x[0], x[1]}, 6 * dp)};
      }
      const std::vector<V> force = bodies.forces();
      double greatest = 0;
      V sum{}, moment{};
      for (int i = 0; i < bodies.s.size(); ++i) {
        sum += force[i];
        moment += cross(bodies.s.x[i], force[i]);
        greatest = std::max(greatest, length(force[i]));
      }
      REQUIRE(greatest > 0.02 * modulus() * dp * dp);
      CHECK(length(sum) < 1e-12 * greatest);
      CHECK(length(moment) < 1e-12 * greatest * 0.01);
      int pushed = 0;
      for (int i = 0; i < bodies.s.size(); ++i) {
        if (length(force[i]) < 0.02 * greatest || ++pushed % 4 != 0) continue;
        for (int k = 0; k < 3; ++k) {
          const double step = 1e-5 * dp, at = bodies.s.x[i][k];
          bodies.s.x[i][k] = at + step;
          const double more = bodies.energy();
          bodies.s.x[i][k] = at - step;
          const double less = bodies.energy();
          bodies.s.x[i][k] = at;
          CHECK(-(more - less) / (2 * step) == Approx(force[i][k]).scale(greatest).epsilon(1e-5));
        }
      }
      CHECK(pushed > 15);
    }
  }

  TEST_CASE(
      "contact of faces: in 3D an oblique impact conserves both momenta, and undamped oenog the energy") {
    Scene scene = small_solid_collision();
    scene.contact = ContactLaw::surface;
    for (const char* method : {"oenog", "tl", "pf-jst"}) {
      CAPTURE(std::string(method));
      Settings settings = with_method(method);
      if (std::string(method) == "oenog") settings.constants["damping"] = 0;
      settings.cfl = 0.2;
      const auto simulation = make_simulation(scene, settings);
      const Balance before = balance(simulation->snapshot(), scene);
      double pressed = 0;
      for (int k = 0; k < 12; ++k) {
        make_steps(*simulation, 20);
        const Snapshot& now = simulation->snapshot();
        const Balance all = balance(now, scene);
        pressed = std::max(pressed, now.contact_energy / before.kinetic);
        if (std::string(method) == "oenog") CHECK(all.kinetic + all.strain == relative(before.kinetic, 3e-3));
      }
      CHECK(pressed > 0.005);
      const Balance after = balance(simulation->snapshot(), scene);
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(after.linear_momentum[k] - before.linear_momentum[k]) < 1e-12 * before.momentum_scale);
        CHECK(std::abs(after.angular_momentum[k] - before.angular_momentum[k]) <
              1e-12 * before.angular_scale);
      }
    }
  }

  TEST_CASE("contact of faces: in 3D a corner that slips past an edge or a corner gains no energy") {
    struct Pair {
      Point middle;
      Rotation upper, lower;
      double half, speed;
    };
    const double root = 1 / std::sqrt(2.0), on_corner = 54.735610317245346;
    const Pair past_edge{{0.00332, 0.001098, 0.009745},
                         {{root, -root, 0}, {}, 46.4456717},
                         {{0.99891, -0.01099, 0.04524}, {}, 44.2344639},
                         0.003,
                         1},
        corners{{0, 0, 0.0141564},
                {{root, -root, 0}, {}, on_corner},
                {{root, -root, 0}, {}, on_corner},
                0.004,
                3};
    for (Pair pair : {past_edge, corners}) {
      CAPTURE(pair.speed);
      const double half = pair.half;
      const Point &m = pair.middle, low{m[0] - half, m[1] - half, m[2] - half},
                  high{m[0] + half, m[1] + half, m[2] + half};
      Scene scene = scene_of({Box{low, high}, Box{{-half, -half, -half}, {half, half, half}}});
      scene.materials = {{"rubber", 1000, 1e6, 0.3}};
      pair.upper.about = m;
      scene.bodies[0].rotation = pair.upper, scene.bodies[1].rotation = pair.lower;
      scene.bodies[0].velocity[2] = constant(-pair.speed), scene.bodies[1].velocity[2] = constant(pair.speed);
      const auto simulation = make_simulation(scene, with_method("oenog"));
      const double given = balance(simulation->snapshot(), scene).kinetic;
      double most = 0, touched = 0;
      while (simulation->time() < 0.006 / pair.speed) {
        make_steps(*simulation, 5);
        const Balance now = balance(simulation->snapshot(), scene);
        most = std::max(most, (now.kinetic + now.strain) / given);
        touched = std::max(touched, simulation->snapshot().contact_energy / given);
      }
      CHECK(most < 1.005);
      CHECK(touched > 0.001);
    }
  }

  TEST_CASE("contact of faces: in 3D mirrored bodies stay mirrored to the last bit") {
    Scene scene = scene_of({Disc{{-0.0042, 0, 0}, 0.004}, Disc{{0.0042, 0, 0}, 0.004}});
    scene.bodies[1].mirror[0] = true;
    for (Body& body : scene.bodies) {
      const double v = (body.mirror[0] ? -0.1 : 0.1) * ring_rubber().sound_speed();
      body.velocity[0] = constant(v);
    }
    const auto simulation = make_simulation(scene, with_method("oenog"));
    make_steps(*simulation, 60);
    const Snapshot& now = simulation->snapshot();
    CHECK(now.contact_energy > 0);
    const std::size_t half = now.size() / 2;
    for (std::size_t i = 0; i < half; ++i) {
      CHECK(now.x[3 * i] == -now.x[3 * (i + half)]);
      CHECK(now.x[3 * i + 1] == now.x[3 * (i + half) + 1]);
      CHECK(now.x[3 * i + 2] == now.x[3 * (i + half) + 2]);
    }
  }
}

TEST_SUITE("failure") {
  TEST_CASE(
      "contact: in 3D closing arms of oenog, tl and pf-jst do not pass through each other under any law") {
    Scene scene = closing_arms(3, dp, 0.006, arm, 0.1);
    for (const char* method : {"oenog", "tl", "pf-jst"}) {
      for (const ContactLaw law : find_method(method)->contact_laws) {
        CAPTURE(std::string(method));
        CAPTURE(std::string(name(law)));
        scene.contact = law;
        const auto simulation = make_simulation(scene, with_method(method));
        const double kinetic = balance(simulation->snapshot(), scene).kinetic;
        double pressed = 0, most = -1;
        for (int k = 1; k <= 20; ++k) {
          simulation->advance_to(0.0001 * k);
          pressed = std::max(pressed, simulation->snapshot().contact_energy / kinetic);
          most = std::max(most, penetration(simulation->snapshot(), 3, dp, arm));
        }
        CHECK(most < 0);
        CHECK(most > -dp);  // the arms meet
        if (law != ContactLaw::impulse) CHECK(pressed > 0.001);
      }
    }
  }
}

TEST_SUITE("failure") {
  TEST_CASE(
      "contact of faces: in 3D a cube that lands on its corner or its edge keeps 90 % of the energy and separates") {
    const double side = 6 * dp, drop = 0.2 * dp, root = 1 / std::sqrt(2.0);
    struct Landing {
      Rotation turn;
      double reach;
    };
    const Landing on_corner{
        {{root, -root, 0}, {0, 0, 0}, std::acos(1 / std::sqrt(3.0)) * 180 / std::numbers::pi},
        0.5 * std::sqrt(3.0) * side},
        on_edge{{{1, 0, 0}, {0, 0, 0}, 45}, root * side};
    for (const Landing& landing : {on_corner, on_edge}) {
      for (const bool on_wall : {true, false}) {
        CAPTURE(landing.reach / dp);
        CAPTURE(on_wall);
        const double half = 0.5 * side;
        Scene scene = scene_of({Box{{-half, -half, -half}, {half, half, half}}});
        scene.bodies[0].rotation = landing.turn;
        if (on_wall) {
          scene.walls = {{"floor", {0, 0, -landing.reach - drop}, {0, 0, 1}}};
        } else {
          const double top = -landing.reach - drop;
          Body& plate = scene.bodies.emplace_back(
              scene_of({Box{{-side, -side, top - 4 * dp}, {side, side, top}}}).bodies[0]);
          plate.name = "plate";
        }
        const double speed = 0.1 * ring_rubber().sound_speed();
        scene.bodies[0].velocity[2] = constant(-speed);
        const auto simulation = make_simulation(scene, with_method("oenog"));
        const double given = balance(simulation->snapshot(), scene).kinetic;
        double most = 0;
        while (simulation->time() < 12 * side / ring_rubber().sound_speed()) {
          make_steps(*simulation, 10);
          const Balance now = balance(simulation->snapshot(), scene);
          most = std::max(most, (now.kinetic + now.strain) / given);
        }
        const Snapshot& now = simulation->snapshot();
        const Balance at_end = balance(now, scene);
        CHECK(most < 1.001);
        CHECK((at_end.kinetic + at_end.strain) / given > 0.9);
        CHECK(now.contact_energy == 0);
        double mean = 0;
        int count = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
          if (now.body[i] == 0) mean += now.v[3 * i + 2], ++count;
        CHECK(mean / count > (on_wall ? 0.4 : -0.3) * speed);
      }
    }
  }
}

TEST_SUITE("restart") {
  TEST_CASE("contact of faces: in 3D a run resumed on more threads gives the same positions and velocities") {
    Scene scene = small_solid_collision();
    scene.contact = ContactLaw::surface;
    scene.bodies[1].shapes[0].shift(0, 5 * dp);
    for (const char* method : {"oenog", "tl"}) {
      CAPTURE(std::string(method));
      Settings settings = with_method(method);
      const auto before = make_simulation(scene, settings);
      while (!(before->snapshot().contact_energy > 0) && before->steps() < 200) make_steps(*before, 1);
      settings.threads = 2;
      const auto after = make_simulation(scene, settings);
      after->load(before->save());
      make_steps(*before, 3), make_steps(*after, 3);
      CHECK(before->snapshot().contact_energy > 0);
      CHECK(after->snapshot().x == before->snapshot().x);
      CHECK(after->snapshot().v == before->snapshot().v);
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE("contact of faces: in 3D a pressed or bent body has no self-contact, a rolled-up body has") {
    CHECK(touching_after<3>([](const V& x) { return V{x[0], 0.6 * x[1], x[2]}; }, dp, 0) == 0);
    CHECK(touching_after<3>([](const V& x) { return bent(x, 0.012); }, dp, 0) == 0);
    CHECK(touching_after<3>([](const V& x) { return bent(x, -0.003); }, dp, 0) > 0);
  }

  TEST_CASE(
      "contact of faces: in 3D bodies too thin for faces, and listed particles, are refused with a reason") {
    const Box block{{0, 0, 0.002}, {0.01, 0.01, 0.006}};
    const std::vector<Point> places = {{0, 0, 0},  {dp, 0, 0},  {0, dp, 0},  {dp, dp, 0},
                                       {0, 0, dp}, {dp, 0, dp}, {0, dp, dp}, {dp, dp, dp}};
    const Shape given = GivenParticles(places, std::vector<double>(8, dp * dp * dp), 3);
    const auto refusal = [&](const Shape& shape, const char* method = "oenog") -> std::string {
      try {
        make_simulation(scene_of({shape, block}), with_method(method));
      } catch (const SceneError& error) {
        CHECK(error.key == (shape.as<Box>() ? "body.body 0" : "contact"));
        return error.what();
      }
      return "";
    };
    for (const char* part : {"'surface'", "'body 0'", "too thin", "smaller spacing"})
      CHECK(refusal(Box{{0, 0, 0}, {0.01, 0.01, dp}}).find(part) != std::string::npos);
    const auto refusal_of_fin = [&]() -> std::string {
      Scene scene = scene_of({Box{{0, 0, 0.01}, {0.005, 0.005, 0.014}}, block});
      scene.bodies[0].shapes.push_back(Box{{0.005, 0, 0.01}, {0.015, 0.005, 0.01 + dp}});
      try {
        make_simulation(scene, with_method("oenog"));
      } catch (const SceneError& error) {
        return error.what();
      }
      return "";
    };
    CHECK(refusal_of_fin().find("too thin") != std::string::npos);
    for (const char* part : {"'surface'", "one by one", "penalty"})
      CHECK(refusal(given).find(part) != std::string::npos);
    CHECK(refusal(given).ends_with("; allowed: penalty, impulse, lennard-jones"));
    CHECK(refusal(given, "enog").ends_with("; allowed: sph, impulse, penalty, lennard-jones"));
    Scene scene = scene_of({given, block});
    scene.contact = ContactLaw::published;
    CHECK_NOTHROW(make_simulation(scene, with_method("oenog")));
  }
}

}  // namespace of_this_file
