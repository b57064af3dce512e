#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/layout/outline.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

double volume(const InitialParticles& layout) {
  return std::accumulate(layout.V0.begin(), layout.V0.end(), 0.0);
}

Scene one_body(int dim, double spacing, const std::vector<Shape>& shapes) {
  Scene scene;
  scene.dim = dim;
  scene.spacing = spacing;
  scene.materials = {ring_rubber()};
  scene.bodies.resize(1);
  scene.bodies[0].name = "thing";
  scene.bodies[0].shapes = shapes;
  return scene;
}

std::string error_of(const Scene& scene) {
  try {
    make_initial_particles(scene);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

double greatest_change_of_distance(const std::vector<Point>& a, const std::vector<Point>& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      greatest =
          std::max(greatest, std::abs(distance_between(a[i], a[j], 3) - distance_between(b[i], b[j], 3)));
  return greatest;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("layout: cylinders in 3D may be solid or hollow along any axis") {
    const Cylinder rod{{0, 0, 0}, {0, 0, 2}, 1}, tube{{1, 2, 3}, {1, 2, 5}, 1, 0.5};
    const Cylinder tilted{{0, 0, 0}, {1, 2, 2}, 1};
    CHECK(volume(make_initial_particles(one_body(3, 0.05, {rod}))) == relative(2 * std::numbers::pi, 0.01));
    CHECK(volume(make_initial_particles(one_body(3, 0.05, {tube}))) ==
          relative(1.5 * std::numbers::pi, 0.01));
    CHECK(volume(make_initial_particles(one_body(3, 0.05, {tilted}))) ==
          relative(3 * std::numbers::pi, 0.01));
    CHECK(rod.bounds().low == Point{-1, -1, 0});
    CHECK(rod.bounds().high == Point{1, 1, 2});
    CHECK(tilted.bounds().low[0] == relative(-std::sqrt(8.0) / 3));
    const InitialParticles ends = make_initial_particles(one_body(3, 0.5, {rod}));
    for (const Point& x : ends.x)
      CHECK(std::abs(x[2] - 1) == relative(std::abs(x[2] - 1) > 0.5 ? 0.75 : 0.25));
    CHECK(fitted_spacing(one_body(3, 1, {tube}).bodies[0], 3, 0.24) == relative(0.25));
  }

  TEST_CASE("layout: a cut-out has no particles") {
    Scene scene = one_body(3, 0.5, {Box{{0, 0, 0}, {4, 4, 4}}});
    scene.bodies[0].without = {Box{{0, 0, 0}, {2, 2, 2}}, Box{{3, 3, 3}, {9, 9, 9}}};
    const InitialParticles layout = make_initial_particles(scene);
    CHECK(layout.size() == 512 - 64 - 8);
    for (const Point& x : layout.x) CHECK_FALSE((x[0] < 2 && x[1] < 2 && x[2] < 2));
    scene.bodies[0].without.push_back(Box{{5, 5, 5}, {6, 6, 6}});
    CHECK(contains(error_of(scene), "without: shape 3 removes no particle of body 'thing'"));
    scene.bodies[0].without = {Disc{{2, 2, 2}, 10}};
    CHECK(contains(error_of(scene), "contains no particle: the rest of its shapes after 'without'"));
  }

  TEST_CASE("layout: a disc with a notch is reflected with its notch") {
    Scene scene = one_body(2, 0.5, {Disc{{3, 0, 0}, 2, RoundLayout::spaced}});
    scene.bodies[0].without = {Box{{4, -1, 0}, {9, 1, 0}}};
    scene.bodies[0].mirror[0] = true;
    const InitialParticles layout = make_initial_particles(scene);
    for (const Point& x : layout.x) CHECK_FALSE((x[0] < 2 && std::abs(x[1]) < 1));
    CHECK(std::ranges::any_of(layout.x, [](const Point& x) { return x[0] > 4 && std::abs(x[1]) < 1; }));
  }

  TEST_CASE("layout: a body is filled on its lattice and then rotated") {
    Scene scene = one_body(3, 0.5, {Box{{0, 0, 0}, {3, 2, 1}}});
    const InitialParticles straight = make_initial_particles(scene);
    scene.bodies[0].rotation = Rotation{{0, 0, 1}, {0, 0, 0}, 90};
    const InitialParticles quarter = make_initial_particles(scene);
    for (int i = 0; i < straight.size(); ++i)
      CHECK(quarter.x[i] == Point{-straight.x[i][1], straight.x[i][0], straight.x[i][2]});
    const double third = 1 / std::sqrt(3.0);
    scene.bodies[0].rotation = Rotation{{third, third, third}, {1, 1, 1}, 120};
    const InitialParticles swapped = make_initial_particles(scene);
    for (int i = 0; i < straight.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) CHECK(swapped.x[i][(k + 1) % 3] == Approx(straight.x[i][k]));
    scene.bodies[0].rotation = Rotation{{0.6, 0, 0.8}, {1, 2, 3}, 33};
    const InitialParticles skew = make_initial_particles(scene);
    CHECK(greatest_change_of_distance(straight.x, skew.x) < 1e-14 * 10);
    CHECK(skew.V0 == straight.V0);
    CHECK(distance_between(rotated({{0, 0, 1}, {1, 0, 0}, 30}, {3, 0, 0}), {1 + std::sqrt(3.0), 1, 0}, 3) <
          1e-15);
    CHECK(rotated({{0, 1, 0}, {0, 0, 0}, -450}, {1, 2, 3}) == Point{-3, 2, 1});
  }

  TEST_CASE("layout: two bodies rotated in opposite directions are mirror images to the last bit") {
    for (const int dim : {2, 3}) {
      Scene scene = one_body(dim, 0.1, {Box{{-2.3, 0.1, 0.3}, {-1, 0.7, 0.6}}});
      scene.bodies[0].rotation = Rotation{{0, 0, 1}, {-2.3, 0.4, 0.1}, 25};
      scene.bodies.push_back(scene.bodies[0]);
      scene.bodies[1].shapes = {Box{{1, 0.1, 0.3}, {2.3, 0.7, 0.6}}};
      scene.bodies[1].rotation = Rotation{{0, 0, 1}, {2.3, 0.4, 0.1}, -25};
      scene.bodies[1].mirror[0] = true;
      const InitialParticles layout = make_initial_particles(scene);
      const int n = layout.first[1];
      REQUIRE(layout.size() == 2 * n);
      for (int i = 0; i < n; ++i)
        CHECK(layout.x[n + i] == Point{-layout.x[i][0], layout.x[i][1], layout.x[i][2]});
    }
  }

  TEST_CASE(
      "layout: particles on the faces of a box between rollers have halves, quarters and eighths of a cell") {
    Scene scene = one_body(3, 0.5, {Box{{0, 0, 0}, {3, 2, 1}}});
    scene.bodies[0].on_boundary = true;
    for (std::size_t k = 0; k < 3; ++k)
      scene.bodies[0].guided[k] = [=](const Point& x) {
        return x[k] == 0 || x[k] == 3.0 - static_cast<double>(k) ? 1.0 : 0.0;
      };
    const InitialParticles layout = make_initial_particles(scene);
    CHECK(layout.size() == 7 * 5 * 3);
    CHECK(volume(layout) == relative(6));
    for (int i = 0; i < layout.size(); ++i) {
      const Point& x = layout.x[i];
      const int faces = (x[0] == 0 || x[0] == 3) + (x[1] == 0 || x[1] == 2) + (x[2] == 0 || x[2] == 1);
      CHECK(layout.V0[i] == relative(std::pow(0.5, 3 + faces)));
    }
    Scene flat = one_body(2, 0.5, {Box{{0, 0, 0}, {3, 2, 0}}});
    flat.bodies[0].on_boundary = true;
    CHECK(make_initial_particles(flat).size() == 7 * 5);
    CHECK(volume(make_initial_particles(flat)) == relative(6));
    flat.bodies[0].loads = {{constant(1), Load::Kind::traction, {constant(1)}, {}}};
    CHECK(contains(error_of(flat), "give the total force as 'force'"));
  }

  TEST_CASE("layout: a box with particles on its faces has its exact volume, centre and moments of inertia") {
    for (const int cells : {1, 2, 3, 4, 7}) {
      CAPTURE(cells);
      const double side[3] = {1.0 * cells, 3, 2}, volume = side[0] * 6;
      // no guides, rollers at x = 0, or also guides along y and z at the opposite face
      for (const int planes : {0, 1, 2}) {
        CAPTURE(planes);
        Scene scene = one_body(3, 1, {Box{{0, 0, 0}, {side[0], side[1], side[2]}}});
        Body& body = scene.bodies[0];
        body.on_boundary = true;
        if (planes > 0) body.guided[0] = [](const Point& x) { return x[0] == 0 ? 1.0 : 0.0; };
        if (planes > 1)
          body.guided[1] = body.guided[2] = [=](const Point& x) { return x[0] == side[0] ? 1.0 : 0.0; };
        const InitialParticles layout = make_initial_particles(scene);
        double total = 0, first[3] = {}, second[3][3] = {};
        for (int i = 0; i < layout.size(); ++i) {
          total += layout.V0[i];
          CHECK(layout.V0[i] == relative(layout.inside[i]));
          for (int a = 0; a < 3; ++a) first[a] += layout.V0[i] * layout.x[i][a];
          for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) second[a][b] += layout.V0[i] * layout.x[i][a] * layout.x[i][b];
        }
        CHECK(total == relative(volume));
        // with planes of symmetry the moments are exact for the body with its image
        for (int a = planes > 0 ? 1 : 0; a < 3; ++a) {
          CHECK(first[a] == relative(volume * side[a] / 2));
          for (int b = planes > 0 ? 1 : 0; b < 3; ++b) {
            if (a == b && a == 0 && cells == 1) continue;  // impossible with two points
            CHECK(second[a][b] == relative(volume * side[a] * side[b] / (a == b ? 3 : 4)));
          }
        }
        if (planes == 1) CHECK(second[0][0] == relative(volume * side[0] * side[0] / 3));
        if (planes == 2) CHECK(layout.V0[0] == relative(0.5 * (1 - 1.0 / 4) / 2 / 3));
      }
    }
  }

  TEST_CASE("layout: displaced bodies start elsewhere and keep their reference configuration") {
    Scene scene = one_body(3, 0.5, {Box{{0, 0, 0}, {2, 1, 1}}});
    CHECK(make_initial_particles(scene).start.empty());
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].name = "other";
    scene.bodies[1].shapes = {Box{{5, 0, 0}, {7, 1, 1}}};
    scene.bodies[0].displacement[2] = [](const Point& x) { return 10 * x[0]; };
    const InitialParticles layout = make_initial_particles(scene);
    REQUIRE(static_cast<int>(layout.start.size()) == layout.size());
    for (int i = 0; i < layout.size(); ++i) {
      const Point& x = layout.x[i];
      CHECK(layout.start[i] == Point{x[0], x[1], x[2] + (layout.body[i] == 0 ? 10 * x[0] : 0)});
    }
    CHECK(layout.x[0] == Point{0.25, 0.25, 0.25});
    scene.bodies[0].displacement = {constant(5), {}, {}};
    CHECK(contains(error_of(scene), "overlap"));
  }

  TEST_CASE("outline: a cut-out adds its faces and removes the faces it covers") {
    Scene scene = one_body(2, 0.5, {Box{{0, 0, 0}, {6, 4, 0}}});
    scene.bodies[0].without = {Box{{2, 2, 0}, {4, 9, 0}}};
    scene.bodies[0].rotation = Rotation{{0, 0, 1}, {0, 0, 0}, 90};
    const Outline outline = make_outline(scene, make_initial_particles(scene));
    double length = 0, area = 0;
    for (const Outline::Segment& segment : outline.segments) {
      const Point &a = outline.x[segment.node[0]], &b = outline.x[segment.node[1]];
      length += segment.length;
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    CHECK(length == relative(2 * (6 + 4) + 2 * 2));
    CHECK(area == relative(6 * 4 - 2 * 2));
    for (const std::array<int, 2>& beside : outline.beside) {
      CHECK(beside[0] != Outline::none);
      CHECK(beside[1] != Outline::none);
    }
    scene.bodies[0].without = {Disc{{3, 2, 0}, 1}};
    const Outline hole = make_outline(scene, make_initial_particles(scene));
    length = 0;
    for (const Outline::Segment& segment : hole.segments) length += segment.length;
    CHECK(length == relative(20 + 2 * std::numbers::pi, 0.02));
  }
}

}  // namespace of_this_file
