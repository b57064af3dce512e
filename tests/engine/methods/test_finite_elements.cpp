#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/critical_step.hpp"
#include "engine/layout/element_nodes.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

const std::vector<std::string> both = {"fe1", "fe2"};

/// Meshed with distorted elements.
Scene round_body(int dim, double dp = 0.25) {
  Scene scene;
  scene.dim = dim;
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  Body body;
  body.name = "body";
  body.shapes = {Disc{{0.3, 0.2, 0.1}, 1}};
  scene.bodies = {body};
  return scene;
}

void displace(Scene& scene, const std::function<Point(const Point&)>& to) {
  for (std::size_t k = 0; k < 3; ++k)
    scene.bodies[0].displacement[k] = [=](const Point& x) { return to(x)[k] - x[k]; };
}

double greatest_speed(const Snapshot& now, const std::function<bool(const Point&)>& counts) {
  double most = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (counts(now.initial(i)))
      for (const double v : now.velocity(i)) most = std::max(most, std::abs(v));
  return most;
}

double strain_energy(const Snapshot& now) {
  return std::accumulate(now.strain_energy.begin(), now.strain_energy.end(), 0.0);
}

/// Place after a smooth displacement with strains up to 0.2.
Point bent(const Point& x, int dim) {
  Point y{x[0] + 0.1 * std::sin(x[0] + 2 * x[1]), x[1] + 0.1 * std::cos(1.7 * x[0] + x[2]), x[2]};
  if (dim == 3) y[2] += 0.1 * std::sin(x[0] - x[1] + 2 * x[2]);
  return y;
}

/// Relative error; reference: finite elements of fourth order, 0.25522 s.
double period_error(const std::string& method, int across) {
  const auto simulation = make_simulation(oscillating_plate(0.001, across), with_method(method));
  simulation->advance_to(0.28);
  const Series& series = simulation->series();
  const std::vector<double>& y = series.value[0];
  std::size_t k = 1;
  while (!(series.time[k] > 0.2 && y[k - 1] < 0 && y[k] >= 0)) REQUIRE(++k < y.size());
  const double share = y[k - 1] / (y[k - 1] - y[k]);
  return std::lerp(series.time[k - 1], series.time[k], share) / 0.25522 - 1;
}

}  // namespace

TEST_SUITE("convergence") {
  TEST_CASE("finite elements: the period of a plate converges, for fe1 with second order") {
    const double coarse = period_error("fe1", 2), fine = period_error("fe1", 4);
    MESSAGE("errors of fe1: " << coarse << ", " << fine << "; of fe2: " << period_error("fe2", 2) << ", "
                              << period_error("fe2", 4));
    CHECK(std::abs(fine) < 0.015);
    CHECK(coarse / fine > 3.5);
    CHECK(coarse / fine < 6);
    CHECK(std::abs(period_error("fe2", 2)) < 0.007);  // one element across
    CHECK(std::abs(period_error("fe2", 4)) < 0.0015);
  }
}

TEST_SUITE("term") {
  TEST_CASE("finite elements: linear displacements give uniform stress, rigid motions none") {
    for (const std::string& method : both)
      for (const int dim : {2, 3}) {
        CAPTURE(method);
        CAPTURE(dim);
        Scene scene = round_body(dim);
        const double K = ring_rubber().bulk_modulus();
        const auto state = [&](const std::function<Point(const Point&)>& to) {
          displace(scene, to);
          const auto simulation = make_simulation(scene, with_method(method));
          const Snapshot start = simulation->snapshot();
          make_steps(*simulation, 1);
          return std::pair(start, simulation->snapshot());
        };
        const auto [rigid, later] = state([&](const Point& x) {
          return Point{1 + 0.6 * x[0] - 0.8 * x[1], -2 + 0.8 * x[0] + 0.6 * x[1], x[2]};
        });
        for (std::size_t i = 0; i < rigid.size(); ++i) CHECK(std::abs(rigid.p[i]) < 1e-12 * K);
        CHECK(strain_energy(rigid) < 1e-20 * K);
        CHECK(greatest_speed(later, [](const Point&) { return true; }) < 1e-11);
        const auto [linear, moved] = state([&](const Point& x) {
          return Point{1.2 * x[0] + 0.3 * x[1], 0.1 * x[0] + 0.9 * x[1], dim == 3 ? 1.1 * x[2] : 0};
        });
        CHECK(std::abs(linear.p[0]) > 1e-3 * K);
        for (std::size_t i = 0; i < linear.size(); ++i) {
          CHECK(linear.p[i] == relative(linear.p[0], 1e-10));
          CHECK(linear.deviator(i).xy == relative(linear.deviator(0).xy, 1e-10));
        }
        const auto inside = [&](const Point& x) { return distance_between(x, {0.3, 0.2, 0.1}, dim) < 0.95; };
        CHECK(greatest_speed(moved, inside) <
              1e-10 * greatest_speed(moved, [](const Point&) { return true; }));
      }
  }

  TEST_CASE("finite elements: forces are minus the derivative of the strain energy") {
    for (const std::string& method : both)
      for (const int dim : {2, 3})
        for (const char* law : {"neo-hookean", "st-venant-kirchhoff"}) {
          CAPTURE(method);
          CAPTURE(dim);
          CAPTURE(law);
          Scene scene = round_body(dim, 0.5);
          scene.materials[0].poisson_ratio = 0.45;
          Settings settings = with_method(method);
          settings.law = law;
          settings.step = 1e-9;
          displace(scene, [=](const Point& x) { return bent(x, dim); });
          const auto simulation = make_simulation(scene, settings);
          const Snapshot start = simulation->snapshot();
          make_steps(*simulation, 1);
          const Snapshot after = simulation->snapshot();
          double scale = 0;
          for (std::size_t i = 0; i < start.size(); ++i)
            for (const double v : after.velocity(i))
              scale = std::max(scale, std::abs(v) * start.m[i] / settings.step);
          const auto energy = [&](std::size_t node, std::size_t axis, double by) {
            const Point at = start.initial(node);
            displace(scene, [=](const Point& x) {
              Point y = bent(x, dim);
              if (distance_between(x, at, 3) < 1e-9) y[axis] += by;
              return y;
            });
            return strain_energy(make_simulation(scene, settings)->snapshot());
          };
          for (const std::size_t node :
               {std::size_t{0}, start.size() / 3, start.size() / 2, start.size() - 1})
            for (std::size_t axis = 0; axis < static_cast<std::size_t>(dim); ++axis) {
              const double by = 1e-5;
              const double slope = (energy(node, axis, by) - energy(node, axis, -by)) / (2 * by);
              const double force = after.velocity(node)[axis] * start.m[node] / settings.step;
              CHECK(std::abs(force + slope) < 1e-6 * scale);
            }
        }
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("finite elements: a vibrating body keeps its energy") {
    for (const std::string& method : both)
      for (const int dim : {2, 3}) {
        CAPTURE(method);
        CAPTURE(dim);
        Scene scene = round_body(dim);
        const double c0 = ring_rubber().sound_speed();
        scene.bodies[0].velocity[0] = [=](const Point& x) { return 0.05 * c0 * (x[0] + std::sin(2 * x[1])); };
        scene.bodies[0].velocity[1] = [=](const Point& x) { return -0.05 * c0 * x[1] * x[0]; };
        const auto simulation = make_simulation(scene, with_method(method));
        const Balance before = balance(simulation->snapshot(), scene);
        double most = 0, strain = 0;
        for (int k = 0; k < 40; ++k) {
          make_steps(*simulation, 25);
          const Balance now = balance(simulation->snapshot(), scene);
          most = std::max(most, std::abs((now.kinetic + now.strain) / before.kinetic - 1));
          strain = std::max(strain, now.strain / before.kinetic);
        }
        CHECK(strain > 0.2);
        CHECK(most < 0.01);
      }
  }
}

TEST_SUITE("stability") {
  TEST_CASE("finite elements: the default step is stable and at least a third of the critical step") {
    for (const std::string& method : both)
      for (const int dim : {2, 3}) {
        CAPTURE(method);
        CAPTURE(dim);
        for (const auto& [nu, is_round] : {std::pair(0.0, false), {0.3, false}, {0.49, false}, {0.3, true}}) {
          CAPTURE(nu);
          CAPTURE(is_round);
          Scene scene = round_body(dim, dim == 2 ? 0.1 : 0.25);
          scene.until = 10;
          if (!is_round) scene.bodies[0].shapes = {Box{{0, 0, 0}, {1, 1, 1}}};
          scene.materials[0].poisson_ratio = nu;
          const CriticalStep found =
              find_critical_step(scene, with_method(method), {.steps = 200, .tolerance = 0.01});
          REQUIRE(found.stable);
          MESSAGE("critical step over default step: " << *found.stable / found.default_step);
          CHECK(*found.stable > 1.05 * found.default_step);
          CHECK(*found.stable < 3 * found.default_step);
        }
      }
  }
}

}  // namespace of_this_file
