#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "engine/layout/surface_mesh.hpp"
#include "engine/scene/shapes/given_particles.hpp"
#include "tests/support/pressed.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.001;

Scene of(const Shape& shape) { return scene_of_shapes({shape}, 3, dp); }

SurfaceMesh mesh_of(const Scene& scene) { return make_surface_mesh(scene, make_initial_particles(scene)); }

std::array<Point, 4> corners(const SurfaceMesh& mesh, const SurfaceMesh::Facet& facet) {
  std::array<Point, 4> x{};
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = mesh.x[facet.node[k]];
  return x;
}

Point middle_of(const SurfaceMesh& mesh, const SurfaceMesh::Facet& facet) {
  Point middle{};
  for (const Point& x : corners(mesh, facet))
    for (std::size_t k = 0; k < 3; ++k) middle[k] += 0.25 * x[k];
  return middle;
}

double area_of(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const SurfaceMesh::Facet& facet : mesh.facets) sum += facet.area;
  return sum;
}

void check_shares(const SurfaceMesh& mesh, const InitialParticles& initial) {
  for (int n = 0; n < mesh.size(); ++n) {
    double one = 0, square = 0;
    Point x{};
    for (int k = mesh.begin[n]; k < mesh.begin[n + 1]; ++k) {
      const auto& [particle, weight] = mesh.shares[k];
      one += weight, square += weight * weight;
      for (std::size_t a = 0; a < 3; ++a) x[a] += weight * initial.x[particle][a];
    }
    CHECK(one == Approx(1).epsilon(1e-12));
    CHECK(distance_between(x, mesh.x[n], 3) < 1e-9 * dp);
    CHECK(square < 4);
  }
}

void check_closed(const Scene& scene, const SurfaceMesh& mesh, double tolerance) {
  Point sum{};
  for (const SurfaceMesh::Facet& facet : mesh.facets) {
    const Point area = vector_area(corners(mesh, facet)), middle = middle_of(mesh, facet);
    Point before = middle, behind = middle;
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k] += area[k];
      before[k] += 0.4 * dp * area[k] / facet.area, behind[k] -= 0.4 * dp * area[k] / facet.area;
    }
    CHECK(distance_between(area, {}, 3) == Approx(facet.area));
    if (facet.area < 0.3 * dp * dp) continue;  // a sliver's normal may lie in the face
    CHECK_FALSE(holds(scene.bodies[0], before, 3, 0));
    CHECK(holds(scene.bodies[0], behind, 3, 0));
  }
  for (const double component : sum) CHECK(std::abs(component) < tolerance);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("surface mesh: the mesh of a box consists of the lattice cells of its faces") {
    const Scene scene = of(Box{{0, 0, 0}, {0.004, 0.005, 0.006}});
    const InitialParticles initial = make_initial_particles(scene);
    const SurfaceMesh mesh = make_surface_mesh(scene, initial);
    CHECK(mesh.facets.size() == 2 * (4 * 5 + 5 * 6 + 6 * 4));
    CHECK(mesh.size() == 5 * 6 * 7 - 3 * 4 * 5);
    CHECK(area_of(mesh) == Approx(148e-6).epsilon(1e-9));
    check_shares(mesh, initial);
    check_closed(scene, mesh, 1e-15);
    for (const SurfaceMesh::Facet& facet : mesh.facets) {
      CHECK(facet.area == Approx(dp * dp));
      CHECK(distance_between(middle_of(mesh, facet), initial.x[facet.particle], 3) == Approx(0.5 * dp));
    }
  }

  TEST_CASE("surface mesh: a box with two sides that are no multiples of the spacing keeps its faces") {
    const Scene scene = of(Box{{0, 0, 0}, {0.004, 0.0053, 0.0057}});
    const SurfaceMesh mesh = mesh_of(scene);
    double low = 1, high = 0;
    for (const Point& x : mesh.x) low = std::min(low, x[2]), high = std::max(high, x[2]);
    CHECK(low == Approx(0).scale(1).epsilon(1e-9));
    CHECK(high == Approx(0.0057).epsilon(1e-5));
    CHECK(area_of(mesh) == Approx(2 * (4 * 5.3 + 5.3 * 5.7 + 5.7 * 4) * 1e-6).epsilon(1e-9));
    const Point corner{0.004, 0.0053, 0.0057};
    CHECK(std::ranges::any_of(mesh.x,
                              [&](const Point& x) { return distance_between(x, corner, 3) < 1e-9 * dp; }));
  }

  TEST_CASE("surface mesh: adjacent shapes, and adjacent cut-outs, have the same faces as their union") {
    // the spacing divides neither side
    const double width = 0.0083, height = 0.0066;
    const auto box = [&](double from, double to, double bottom, double top) {
      return Box{{from, 0, bottom}, {to, width, top}};
    };
    Scene whole = of(box(0, 0.012, 0, height)), pieces = of(box(0, 0.004, 0, height));
    pieces.bodies[0].shapes.push_back(box(0.004, 0.0074, 0, height));
    pieces.bodies[0].shapes.push_back(box(0.0074, 0.012, 0, height));
    const auto check_alike = [&] {
      const SurfaceMesh one = mesh_of(whole), other = mesh_of(pieces);
      CHECK(one.facets.size() == other.facets.size());
      CHECK(area_of(one) == Approx(area_of(other)).epsilon(0.01));
      for (const Point& x : other.x) {
        CHECK(holds(whole.bodies[0], x, 3, 1e-5 * dp));
        CHECK_FALSE(holds(whole.bodies[0], x, 3, -1e-5 * dp));
      }
      check_closed(pieces, other, 1e-9 * area_of(other));
    };
    check_alike();
    whole.bodies[0].without = {box(0.0043, 0.0095, 0.0027, 1)};
    pieces.bodies[0].without = {box(0.0043, 0.007, 0.0027, 1), box(0.007, 0.0095, 0.0027, 1)};
    check_alike();
  }

  TEST_CASE("surface mesh: if particles lie on the faces of a box, the mesh lies on these faces, too") {
    Scene scene = of(Box{{0, 0, 0}, {0.004, 0.005, 0.006}});
    scene.bodies[0].on_boundary = true;
    const InitialParticles initial = make_initial_particles(scene);
    const SurfaceMesh mesh = make_surface_mesh(scene, initial);
    CHECK(area_of(mesh) == Approx(148e-6).epsilon(1e-6));
    check_shares(mesh, initial);
    for (const Point& x : mesh.x) {
      CHECK(holds(scene.bodies[0], x, 3, 1e-5 * dp));
      CHECK_FALSE(holds(scene.bodies[0], x, 3, -1e-5 * dp));
    }
  }

  TEST_CASE("surface mesh: lattice steps at a ball, its hole and a bar are smoothed") {
    const double R = 0.008, r = 0.004, pi = std::numbers::pi;
    const Scene shell = of(Ring{{0.0003, 0, 0}, r, R}), bar = of(Cylinder{{0, 0, 0}, {0.012, 0, 0}, 0.005});
    const SurfaceMesh round = mesh_of(shell), along = mesh_of(bar);
    for (const Point& x : round.x) {
      const double from = distance_between(x, {0.0003, 0, 0}, 3);
      CHECK(std::min(std::abs(from - r), std::abs(from - R)) < 1e-5 * dp);
    }
    CHECK(area_of(round) == Approx(4 * pi * (r * r + R * R)).epsilon(0.02));
    CHECK(area_of(along) == Approx(2 * pi * 0.005 * (0.012 + 0.005)).epsilon(0.03));
    check_closed(shell, round, 1e-3 * area_of(round));
    check_shares(round, make_initial_particles(shell));
  }

  TEST_CASE(
      "surface mesh: a mirrored body has the mirror image to the last bit, a rotated body a rotated mesh") {
    Scene scene = of(Disc{{0.011, 0.002, 0.001}, 0.006});
    const SurfaceMesh one = mesh_of(scene);
    scene.bodies[0].shapes = {Disc{{-0.011, 0.002, 0.001}, 0.006}};
    scene.bodies[0].mirror[0] = true;
    const SurfaceMesh image = mesh_of(scene);
    REQUIRE(image.size() == one.size());
    REQUIRE(image.facets.size() == one.facets.size());
    for (int n = 0; n < one.size(); ++n) CHECK(image.x[n] == Point{-one.x[n][0], one.x[n][1], one.x[n][2]});
    for (std::size_t f = 0; f < one.facets.size(); ++f) {
      const Point a = vector_area(corners(one, one.facets[f])),
                  b = vector_area(corners(image, image.facets[f]));
      CHECK(b == Point{-a[0], a[1], a[2]});
    }
    Scene turned = of(Box{{0, 0, 0}, {0.004, 0.005, 0.006}});
    turned.bodies[0].rotation = Rotation{{0, 0, 1}, {0.001, 0, 0}, 30};
    const SurfaceMesh mesh = mesh_of(turned);
    CHECK(mesh.facets.size() == 148);
    CHECK(area_of(mesh) == Approx(148e-6).epsilon(1e-9));
    check_closed(turned, mesh, 1e-15);
  }

  TEST_CASE("surface mesh: bodies in 2D, of one layer or of listed particles have no mesh") {
    CHECK(mesh_of(scene_of_shapes({Box{{0, 0, 0}, {0.004, 0.004, 0}}}, 2, dp)).facets.empty());
    CHECK(mesh_of(of(Box{{0, 0, 0}, {0.02, 0.02, dp}})).facets.empty());
    CHECK(can_have_surface_mesh(of(Disc{{0, 0, 0}, 0.004})));
    const std::vector<Point> places = {{0, 0, 0}, {dp, 0, 0}, {0, dp, 0}, {0, 0, dp}};
    const std::vector<double> volumes(4, dp * dp * dp);
    CHECK_FALSE(can_have_surface_mesh(of(GivenParticles(places, volumes, 3))));
  }
}

}  // namespace of_this_file
