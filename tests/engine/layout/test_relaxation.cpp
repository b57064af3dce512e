#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/layout/initial_particles.hpp"
#include "engine/layout/outline.hpp"
#include "engine/layout/surface_mesh.hpp"
#include "engine/scene/shapes/combined.hpp"
#include "engine/scene/shapes/ellipse.hpp"
#include "engine/scene/shapes/mesh.hpp"
#include "engine/scene/shapes/polygon.hpp"
#include "engine/scene/shapes/turned.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.05;

Scene relaxed_body(const std::vector<Shape>& shapes, const std::vector<Shape>& without = {}, int dim = 2) {
  Scene scene;
  scene.dim = dim;
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  scene.bodies.resize(1);
  scene.bodies[0].name = "thing";
  scene.bodies[0].shapes = shapes;
  scene.bodies[0].without = without;
  scene.bodies[0].relaxed = true;
  return scene;
}

Shape star() {
  Chain corners;
  for (int n = 0; n < 10; ++n) {
    const double angle = (n + 0.3) * std::numbers::pi / 5, r = n % 2 == 0 ? 1 : 0.5;
    corners.push_back({r * std::cos(angle), r * std::sin(angle), 0});
  }
  return Polygon(std::vector<Chain>{corners});
}

/// |x| + |y| + |z| < radius.
Shape octahedron(double radius) {
  Triangles mesh;
  for (const double side : {radius, -radius})
    for (std::size_t k = 0; k < 3; ++k) mesh.points.emplace_back()[k] = side;
  for (int n = 0; n < 8; ++n) {
    std::array<int, 3> corner{n & 1 ? 3 : 0, n & 2 ? 4 : 1, n & 4 ? 5 : 2};
    if (std::popcount(static_cast<unsigned>(n)) % 2 != 0) std::swap(corner[1], corner[2]);
    mesh.corners.push_back(corner);
  }
  return Mesh(mesh);
}

double volume(const InitialParticles& layout) {
  return std::accumulate(layout.V0.begin(), layout.V0.end(), 0.0);
}

/// In spacings, shortest first.
std::vector<double> distances_to_nearest(const std::vector<Point>& from, const std::vector<Point>& to,
                                         int dim) {
  std::vector<double> all;
  for (const Point& x : from) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point& y : to)
      if (&x != &y) nearest = std::min(nearest, distance_between(x, y, dim) / dp);
    all.push_back(nearest);
  }
  std::ranges::sort(all);
  return all;
}

void check_follows_faces(const Scene& scene, const std::vector<Point>& faces, double least_depth) {
  const InitialParticles layout = make_initial_particles(scene);
  REQUIRE(faces.size() > 20);
  CHECK(distances_to_nearest(layout.x, layout.x, scene.dim).front() > 0.7);
  std::vector<double> first_row = distances_to_nearest(layout.x, faces, scene.dim);
  CHECK(first_row.front() > least_depth);
  first_row.erase(std::ranges::lower_bound(first_row, 0.85), first_row.end());
  CHECK(first_row[first_row.size() / 20] > 0.42);
  CHECK(first_row[first_row.size() * 19 / 20] < 0.62);
  const std::vector<double> uncovered = distances_to_nearest(faces, layout.x, scene.dim);
  CHECK(uncovered[uncovered.size() * 9 / 10] < 0.8);
  for (const double V : layout.V0) {
    REQUIRE(V > 0.5 * std::pow(dp, scene.dim));
    REQUIRE(V < 1.5 * std::pow(dp, scene.dim));
  }
}

std::vector<Point> points_on_outline(const Scene& scene) {
  const Outline outline = make_outline(scene, make_initial_particles(scene));
  std::vector<Point> points;
  constexpr int along = 16;
  for (const Outline::Segment& segment : outline.segments) {
    const Point &a = outline.x[static_cast<std::size_t>(segment.node[0])],
                &b = outline.x[static_cast<std::size_t>(segment.node[1])];
    for (int n = 0; n < along; ++n) {
      const double share = (n + 0.5) / along;
      points.push_back({a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), 0});
    }
  }
  return points;
}

std::vector<Point> points_on_sphere(double radius) {
  constexpr int number = 30000;
  std::vector<Point> points;
  for (int n = 0; n < number; ++n) {
    const double z = 1 - (2 * n + 1.0) / number, angle = n * std::numbers::pi * (3 - std::sqrt(5.0)),
                 r = std::sqrt(1 - z * z);
    points.push_back({radius * r * std::cos(angle), radius * r * std::sin(angle), radius * z});
  }
  return points;
}

/// Ball in its torsional mode of order 2, u = j2(kr)/r² z (−y, x, 0) with kR = 2.50113.
struct TwistingBall {
  Scene scene = relaxed_body({Disc{{0, 0, 0}, 5 * dp}}, {}, 3);
  double period = 0;

  TwistingBall() {
    const double R = 5 * dp, k = 2.5011326 / R;
    const Material& rubber = scene.materials[0];
    const double shear_speed = std::sqrt(rubber.shear_modulus() / rubber.density);
    period = 2 * std::numbers::pi / (k * shear_speed);
    const auto over_r = [=](const Point& x) {
      const double r = std::max(1e-3 * R, distance_between(x, {}, 3)), kr = k * r;
      const double j2 = (3 / (kr * kr * kr) - 1 / kr) * std::sin(kr) - 3 * std::cos(kr) / (kr * kr);
      return 1e-2 * shear_speed * j2 / (r * r) * x[2];
    };
    scene.bodies[0].velocity[0] = [=](const Point& x) { return -over_r(x) * x[1]; };
    scene.bodies[0].velocity[1] = [=](const Point& x) { return over_r(x) * x[0]; };
    scene.probes = {make_probe("pole", Probe::Kind::displacement)};
    scene.probes[0].at = {R / std::numbers::sqrt2, 0, R / std::numbers::sqrt2};
    scene.probes[0].axis = 1;
  }

  double relative_error(const std::string& method) const {
    Settings settings;
    settings.method = method;
    settings.threads = 1;
    const auto simulation = make_simulation(scene, settings);
    simulation->advance_to(0.7 * period);
    const std::vector<double>&t = simulation->series().time, &y = simulation->series().value[0];
    for (std::size_t n = 2; n < t.size(); ++n)
      if ((y[n - 1] > 0) != (y[n] > 0))
        return 2 * (t[n - 1] + (t[n] - t[n - 1]) * y[n - 1] / (y[n - 1] - y[n])) / period - 1;
    FAIL("the probe does not return to its start");
    return 0;
  }
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("relaxation: outer particles of shapes in 2D are about half a spacing inside") {
    Scene scene;
    double least_depth = 0.35;
    SUBCASE("disc") { scene = relaxed_body({Disc{{0.01, 0.02, 0}, 1}}); }
    SUBCASE("ring") { scene = relaxed_body({Ring{{0, 0, 0}, 0.6, 1}}); }
    SUBCASE("ellipse") { scene = relaxed_body({Ellipse{{0, 0, 0}, {1, 0.6, 1}}}); }
    SUBCASE("star") { scene = relaxed_body({star()}); }
    SUBCASE("disc on a box, with a hole") {
      scene = relaxed_body({Box{{-1, -0.8, 0}, {1, 0, 0}}, Disc{{0, 0, 0}, 0.7}}, {Disc{{0, -0.1, 0}, 0.3}});
    }
    SUBCASE("box without a turned box, on a turned lattice") {
      const Rotation turn{.angle = 20};
      scene = relaxed_body(
          {Turned{Combined{Combination::difference,
                           {Box{{0, 0, 0}, {1.5, 1, 0}}, Turned{Box{{0.5, 0.3, 0}, {1, 0.6, 0}}, turn}}},
                  turn}});
    }
    check_follows_faces(scene, points_on_outline(scene), least_depth);
  }

  TEST_CASE("relaxation: outer particles of a ball and of a mesh are about half a spacing inside") {
    check_follows_faces(relaxed_body({Disc{{0, 0, 0}, 0.4}}, {}, 3), points_on_sphere(0.4), 0.3);
    std::vector<Point> on_octahedron = points_on_sphere(1);
    for (Point& x : on_octahedron) {
      const double norm = std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]);
      for (double& component : x) component *= 0.5 / norm;
    }
    check_follows_faces(relaxed_body({octahedron(0.5)}, {}, 3), on_octahedron, 0.3);
  }

  TEST_CASE(
      "relaxation: particles have the volume of one shape to round-off, and of combined shapes within 2e-4") {
    const auto total = [](const Scene& scene) { return volume(make_initial_particles(scene)); };
    CHECK(total(relaxed_body({Disc{{0.01, 0.02, 0}, 1}})) == relative(std::numbers::pi, 1e-12));
    CHECK(total(relaxed_body({Disc{{0, 0, 0}, 0.3}}, {}, 3)) == relative(0.036 * std::numbers::pi, 1e-12));
    CHECK(total(relaxed_body({octahedron(0.4)}, {}, 3)) == relative(4.0 / 3 * 0.064, 1e-12));
    CHECK(total(relaxed_body({Box{{-1, -0.8, 0}, {1, 0, 0}}, Disc{{0, 0, 0}, 0.7}},
                             {Disc{{0, -0.1, 0}, 0.3}})) == relative(1.6 + 0.155 * std::numbers::pi, 2e-4));
  }

  TEST_CASE("relaxation: a lattice that fits its body is unchanged, also far from a cut-out") {
    Scene scene = relaxed_body({Box{{0, 0, 0}, {1, 0.5, 0}}, Box{{1, 0, 0}, {1.5, 1, 0}}});
    const auto layout_if = [&](bool relaxed) {
      scene.bodies[0].relaxed = relaxed;
      return make_initial_particles(scene);
    };
    CHECK(layout_if(true).x == layout_if(false).x);
    CHECK(layout_if(true).V0 == layout_if(false).V0);
    CHECK(layout_if(true).relaxed == std::vector<bool>{false});
    scene.bodies[0].without = {Disc{{0.25, 0.25, 0}, 0.13}};
    const InitialParticles relaxed = layout_if(true), lattice = layout_if(false);
    CHECK(relaxed.relaxed == std::vector<bool>{true});
    const auto on_lattice = std::ranges::count_if(relaxed.x, [&](const Point& x) {
      return std::ranges::any_of(lattice.x,
                                 [&](const Point& y) { return distance_between(x, y, 2) < 1e-9 * dp; });
    });
    CHECK(on_lattice > 0.6 * lattice.size());
    CHECK(on_lattice < 0.9 * lattice.size());
  }

  TEST_CASE("relaxation: mirrored bodies are exact images") {
    Scene scene = relaxed_body({Disc{{-1.5, 0, 0}, 1}});
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].name = "image";
    scene.bodies[1].shapes = {Disc{{1.5, 0, 0}, 1}};
    scene.bodies[1].mirror[0] = true;
    const InitialParticles layout = make_initial_particles(scene);
    for (int i = 0; i < layout.first[1]; ++i) {
      const Point &a = layout.x[i], &b = layout.x[layout.first[1] + i];
      REQUIRE(a[0] == -b[0]);
      REQUIRE(a[1] == b[1]);
    }
  }

  TEST_CASE("relaxation: the surface mesh of a ball is closed and has its area within 3 %") {
    const Scene scene = relaxed_body({Disc{{0, 0, 0}, 0.4}}, {}, 3);
    const SurfaceMesh mesh = make_surface_mesh(scene, make_initial_particles(scene));
    CHECK(mesh.closed == std::vector<bool>{true});
    double area = 0;
    Point sum{};
    for (std::size_t k = 0; k < mesh.facets.size(); ++k) {
      std::array<Point, 4> corner{};
      for (std::size_t c = 0; c < 4; ++c)
        corner[c] = mesh.x[static_cast<std::size_t>(mesh.facets[k].node[c])];
      const Point of = vector_area(corner);
      area += mesh.facets[k].area;
      for (std::size_t a = 0; a < 3; ++a) sum[a] += of[a];
    }
    CHECK(area == relative(0.64 * std::numbers::pi, 0.03));
    CHECK(distance_between(sum, {}, 3) < 1e-2 * area);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("relaxation: a twisting ball ten particles across has nearly its exact period") {
    const TwistingBall ball;
    CHECK(std::abs(ball.relative_error("oenog")) < 0.01);
    CHECK(std::abs(ball.relative_error("tl")) < 0.035);
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("relaxation: 1 and 3 threads give the same positions") {
    Scene scene = small_collision();
    for (Body& body : scene.bodies) body.relaxed = true;
    Settings settings;
    settings.method = "oenog";
    const auto end = [&](int threads) {
      settings.threads = threads;
      const auto simulation = make_simulation(scene, settings);
      simulation->advance_to(2e-5);
      return simulation->snapshot().x;
    };
    CHECK(end(1) == end(3));
  }
}

}  // namespace of_this_file
