#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/layout/outline.hpp"
#include "engine/scene/shapes/combined.hpp"
#include "engine/scene/shapes/ellipse.hpp"
#include "engine/scene/shapes/given_particles.hpp"
#include "engine/scene/shapes/implicit.hpp"
#include "engine/scene/shapes/polygon.hpp"
#include "engine/scene/shapes/turned.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double pi = std::numbers::pi;

Scene scene_of(double dp, std::vector<Shape> shapes, int dim = 2) {
  Scene scene;
  scene.dim = dim;
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  Body body;
  body.name = "body";
  body.shapes = std::move(shapes);
  scene.bodies = {body};
  return scene;
}

double volume(const Scene& scene) {
  const InitialParticles layout = make_initial_particles(scene);
  return std::accumulate(layout.V0.begin(), layout.V0.end(), 0.0);
}

void check_converges(const Shape& shape, double exact, double dp, int dim = 2) {
  double first = 0, last = 0;
  for (const double part : {1.0, 0.5, 0.25}) {
    const double error = std::abs(volume(scene_of(part * dp, {shape}, dim)) / exact - 1);
    if (part == 1) first = error;
    last = error;
    CAPTURE(part);
    CHECK(error < 0.08 * part);
  }
  CHECK(last < std::max(0.5 * first, 0.003));
}

Chain star(double outer, double inner) {
  Chain points;
  for (int k = 0; k < 10; ++k) {
    const double r = k % 2 == 0 ? outer : inner, angle = pi * k / 5;
    points.push_back({r * std::sin(angle), r * std::cos(angle), 0});
  }
  return points;
}
double area_of_star(double outer, double inner) { return 5 * outer * inner * std::sin(pi / 5); }

Chain square(double half) { return {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}; }

void check_outline(const Scene& scene, double length, double area, double tolerance) {
  const Outline outline = make_outline(scene, make_initial_particles(scene));
  double sum = 0, twice = 0;
  for (const Outline::Segment& segment : outline.segments) {
    const Point &a = outline.x[segment.node[0]], &b = outline.x[segment.node[1]];
    sum += segment.length;
    twice += segment.sense * (a[0] * b[1] - a[1] * b[0]);
  }
  CHECK(sum == relative(length, tolerance));
  CHECK(0.5 * twice == relative(area, tolerance));
  for (int n = 0; n < outline.size(); ++n) {
    CHECK(outline.beside[n][0] != Outline::none);
    CHECK(outline.beside[n][1] != Outline::none);
    CHECK(holds(scene.bodies[0], outline.x[n], 2, 0.01 * scene.spacing));
    CHECK_FALSE(holds(scene.bodies[0], outline.x[n], 2, -0.01 * scene.spacing));
  }
}

std::string error_of(const Scene& scene) {
  try {
    make_initial_particles(scene);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) {
  INFO(text);
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("shapes: the particles' volume converges to the shape's") {
    check_converges(Ellipse{{0.1, 0.2, 0}, {0.03, 0.011, 1}}, pi * 0.03 * 0.011, 0.002);
    check_converges(Ellipse{{0, 0.1, 0}, {0.03, 0.012, 0.02}}, 4 * pi / 3 * 0.03 * 0.012 * 0.02, 0.004, 3);
    check_converges(Polygon({star(0.03, 0.013)}, Point{0.1, 0, 0}), area_of_star(0.03, 0.013), 0.002);
    check_converges(Polygon({square(0.0197), star(0.015, 0.007)}),
                    0.0394 * 0.0394 - area_of_star(0.015, 0.007), 0.002);
    const Expression disc = [](const Point& x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2] < 4e-4; };
    check_converges(Implicit{{{-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02}}, disc}, pi * 4e-4, 0.002);
    check_converges(Implicit{{{-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02}}, disc}, 4 * pi / 3 * 8e-6, 0.004, 3);
  }

  TEST_CASE("shapes: unions, intersections and differences nest") {
    const Shape big = Disc{{0, 0, 0}, 0.02}, small = Disc{{0, 0, 0}, 0.01};
    const Shape right = Box{{0, -0.03, 0}, {0.03, 0.03, 0}};
    const Shape ring = Combined{Combination::difference, {big, small}};
    const double of_ring = pi * (4e-4 - 1e-4);
    check_converges(ring, of_ring, 0.002);
    const Shape half = Combined{Combination::common, {ring, right}};
    check_converges(half, 0.5 * of_ring, 0.002);
    const Shape both = Combined{Combination::together, {half, small}};
    check_converges(both, 0.5 * of_ring + pi * 1e-4, 0.002);
    check_outline(scene_of(0.0005, {ring}), 2 * pi * 0.03, of_ring, 2e-3);
    check_outline(scene_of(0.0005, {both}), pi * 0.02 + 0.02 + pi * 0.01, 0.5 * of_ring + pi * 1e-4, 5e-3);
    Scene scene = scene_of(0.0005, {Ellipse{{0, 0, 0}, {0.02, 0.02, 1}}});
    scene.bodies[0].without = {small};
    check_outline(scene, 2 * pi * 0.03, of_ring, 2e-3);
  }

  TEST_CASE("shapes: outlines of ellipses, polygons and implicit shapes have their length and area") {
    const double dp = 0.0005, a = 0.02, b = 0.01;
    // Ramanujan's perimeter of an ellipse
    const double h = 3 * (a - b) * (a - b) / ((a + b) * (a + b));
    const double around = pi * (a + b) * (1 + h / (10 + std::sqrt(4 - h)));
    const Shape ellipse = Ellipse{{0.003, 0.001, 0}, {a, b, 1}};
    check_outline(scene_of(dp, {ellipse}), around, pi * a * b, 1e-3);
    const double side = std::hypot(0.02 * std::sin(pi / 5), 0.02 * std::cos(pi / 5) - 0.009);
    const Scene of_star = scene_of(
        dp, {Turned{Polygon({star(0.009, 0.02)}, Point{0.1, 0, 0}), {.about = {0.1, 0, 0}, .angle = 17}}});
    check_outline(of_star, 10 * side, area_of_star(0.02, 0.009), 1e-9);
    check_outline(scene_of(dp, {Polygon({square(0.02), square(0.01)})}), 0.16 + 0.08, 16e-4 - 4e-4, 1e-9);
    const Expression disc = [](const Point& x) { return x[0] * x[0] + x[1] * x[1] < 4e-4; };
    check_outline(scene_of(dp, {Implicit{{{-0.03, -0.03, 0}, {0.03, 0.03, 0}}, disc}}), 2 * pi * 0.02,
                  pi * 4e-4, 1e-3);
  }

  TEST_CASE("shapes: points of a contour are evenly spaced between corners, however its own points lie") {
    const Chain lines = {{0, 0, 0}, {0.1, 0, 0}, {0.3, 0, 0}, {1, 0, 0}, {1, 0.6, 0}, {1, 1, 0}, {0, 1, 0}};
    const Chain even = evenly_spaced(lines, 0.25);
    REQUIRE(even.size() == 16);
    for (std::size_t k = 0; k < even.size(); ++k)
      CHECK(distance_between(even[k], even[(k + 1) % even.size()], 2) == relative(0.25, 1e-12));
  }

  TEST_CASE("shapes: crossing contours are found") {
    CHECK_FALSE(crossing({star(0.02, 0.01)}));
    CHECK_FALSE(crossing({square(2), square(1)}));
    const auto bow = crossing({{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}});
    REQUIRE(bow);
    CHECK((*bow)[0] == relative(1));
    CHECK((*bow)[1] == relative(1));
    CHECK(crossing({square(1), {{0.5, 0, 0}, {3, 0, 0}, {3, 0.5, 0}}}));
    CHECK(crossing({{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}}}));
  }

  TEST_CASE("shapes: a rotated shape has the particles of a rotated body to the last bit") {
    const double dp = 0.001;
    for (const Shape& shape :
         {Shape(Box{{0, 0, 0}, {0.02, 0.007, 0}}), Shape(Disc{{0.003, 0, 0}, 0.01, RoundLayout::spaced}),
          Shape(Polygon({star(0.02, 0.009)}, Point{0.1, 0, 0}))}) {
      const Point middle = shape->middle();
      Scene body = scene_of(dp, {shape});
      body.bodies[0].rotation = Rotation{.about = middle, .angle = 33};
      const Scene turned = scene_of(dp, {Turned{shape, *body.bodies[0].rotation}});
      CHECK(make_initial_particles(turned).x == make_initial_particles(body).x);
      CHECK(make_outline(turned, make_initial_particles(turned)).x ==
            make_outline(body, make_initial_particles(body)).x);
    }
    const auto quarter = [&](double angle) {
      const Shape box = Box{{-0.01, -0.004, 0}, {0.01, 0.004, 0}};
      std::vector<Point> x =
          make_initial_particles(scene_of(dp, {Turned{box, {.about = {}, .angle = angle}}})).x;
      for (Point& p : x)
        if (angle == 90) p = {p[1], -p[0], 0};
      return x;
    };
    CHECK(quarter(90) == quarter(0));
  }

  TEST_CASE("shapes: mirrored ellipses and polygons are images of unmirrored ones to the last bit") {
    for (const double side : {-1.0, 1.0}) {
      const Point centre{side * 0.0313, 0.002, 0};
      const Shape shapes[] = {Ellipse{centre, {0.02, 0.01, 1}}, Polygon({star(0.02, 0.009)}, centre)};
      for (const Shape& shape : shapes) {
        Scene one = scene_of(0.001, {shape}), other = one;
        other.bodies[0].mirror[0] = true;
        std::vector<Shape> at_image = other.bodies[0].shapes;
        at_image[0].shift(0, -2 * centre[0]);
        const Scene image = scene_of(0.001, at_image);
        std::vector<Point> mirrored = make_initial_particles(other).x;
        for (Point& x : mirrored) x[0] = -x[0];
        CHECK(mirrored == make_initial_particles(image).x);
      }
    }
  }

  TEST_CASE(
      "shapes: in a hexagonal lattice each particle has the area dp² and six neighbours, and rows fill the height") {
    const double height = 0.01;
    Scene scene = scene_of(0.001, {Box{{0, 0, 0}, {0.1, height, 0}}});
    scene.bodies[0].lattice = Lattice::hexagonal;
    scene.spacing = fitted_spacing(scene.bodies[0], 2, 0.001);
    const double dp = scene.spacing, pitch = dp / hexagonal_row;
    CHECK(height / (dp * hexagonal_row) == relative(std::round(height / (0.001 * hexagonal_row)), 1e-12));
    CHECK(dp == relative(0.001, 0.05));
    CHECK(fitted_spacing(scene.bodies[0], 2, dp) == dp);
    CHECK(volume(scene) == relative(1e-3, 0.005));
    const InitialParticles layout = make_initial_particles(scene);
    for (int i = 0; i < layout.size(); ++i) {
      CHECK(layout.V0[i] == relative(dp * dp));
      if (std::abs(layout.x[i][0] - 0.05) > 0.04 || std::abs(layout.x[i][1] - 0.005) > 0.003) continue;
      int near = 0;
      for (int j = 0; j < layout.size(); ++j) {
        const double r = distance_between(layout.x[i], layout.x[j], 2);
        if (j == i || r > 1.5 * pitch) continue;
        CHECK(r == relative(pitch, 1e-9));
        ++near;
      }
      CHECK(near == 6);
    }
  }

  TEST_CASE("shapes: listed particles keep their positions, with faces half a spacing outside") {
    std::vector<Point> places;
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 30; ++i) places.push_back({0.001 * (i + 0.5), 0.001 * (j + 0.5), 0});
    const Scene scene =
        scene_of(0.001, {GivenParticles(places, std::vector<double>(places.size(), 1e-6), 2)});
    CHECK(make_initial_particles(scene).x == places);
    const Outline outline = make_outline(scene, make_initial_particles(scene));
    double length = 0, low = 0, high = 0;
    for (const Outline::Segment& segment : outline.segments) length += segment.length;
    for (const Point& x : outline.x) low = std::min(low, x[0]), high = std::max(high, x[1]);
    CHECK(length == relative(0.1, 0.03));
    CHECK(low == relative(0, 1e-4).scale(1));
    CHECK(high == relative(0.02, 0.01));
  }

  TEST_CASE("shapes: an overlap of bodies is refused with its place") {
    Scene scene = scene_of(0.001, {Box{{0, 0, 0}, {0.02, 0.02, 0}}});
    Body other = scene.bodies[0];
    other.name = "other";
    other.shapes = {Ellipse{{0.0305, 0.01, 0}, {0.01, 0.01, 1}}};
    scene.bodies.push_back(other);
    CHECK(error_of(scene).empty());
    scene.bodies[1].shapes = {Ellipse{{0.0288, 0.01, 0}, {0.01, 0.01, 1}}};
    const std::string deep = error_of(scene);
    CHECK(has(deep, "bodies 'other' and 'body' overlap at (0.0"));
    CHECK(has(deep, ") m: "));
    // particles at the corners of the other body's cells
    scene.bodies[1].shapes = {Box{{0.0055, 0.0055, 0}, {0.0105, 0.0105, 0}}};
    CHECK(has(error_of(scene), "overlap at (0.0065, 0.0065) m: a particle of 'body' is inside 'other'"));
    scene.bodies[0].shapes = {Box{{0, 0, 0}, {0.02, 0.02, 0.02}}};
    scene.dim = 3;
    scene.bodies[1].shapes = {Box{{0.0055, 0.0055, 0.0055}, {0.0105, 0.0105, 0.0105}}};
    CHECK(has(error_of(scene), "(0.0065, 0.0065, 0.0065) m"));
  }

  TEST_CASE("shapes: empty regions and too large lattices are refused") {
    Scene scene = scene_of(0.001, {Box{{0, 0, 0}, {0.02, 0.02, 0}}});
    scene.bodies[0].clamped = [](const Point& x) { return x[0] < -1; };
    CHECK(has(error_of(scene), "held: no particle of body 'body' is held"));
    scene.bodies[0].clamped = {};
    scene.bodies[0].guided[1] = [](const Point& x) { return x[0] < -1; };
    CHECK(has(error_of(scene), "held[1]"));
    scene.bodies[0].guided = {};
    scene.bodies[0].shapes.push_back(Box{{1e6, 1e6, 0}, {1e6 + 0.1, 1e6 + 0.1, 0}});
    CHECK(has(error_of(scene), "lattice sites"));
  }
}

}  // namespace of_this_file
