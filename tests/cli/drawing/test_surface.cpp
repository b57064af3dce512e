#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <doctest/doctest.h>

#include "cli/drawing/delaunay.hpp"
#include "cli/drawing/staging.hpp"
#include "cli/drawing/surface.hpp"
#include "engine/scene/shapes/box.hpp"
#include "engine/scene/shapes/polygon.hpp"
#include "engine/scene/shapes/round_shapes.hpp"
#include "tests/support/pressed.hpp"
#include "tests/support/relative.hpp"

namespace of_surfaces {

namespace {

using namespace taut;
using namespace taut::cli;
using namespace taut::test;
using Numbers = std::vector<double>;
using Map = std::array<std::array<double, 3>, 3>;

constexpr double spacing = 0.01;  // m
constexpr Map stretch{{{1.7, 0.3, 0}, {0, 0.8, 0.2}, {0.1, 0, 1.1}}};

struct Covered {
  Scene scene;
  Origins origins;
  std::vector<std::size_t> shown;
  Surface surface;

  explicit Covered(const Scene& of, const Expression& is_cut = {})
      : scene(of), origins(origins_of(of)), shown(kept(is_cut)), surface(scene, origins, shown, is_cut) {}
  std::vector<std::size_t> kept(const Expression& is_cut) const {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < origins.size(); ++i) {
      const auto d = static_cast<std::size_t>(scene.dim);
      Point x{};
      std::copy_n(&origins.x0[d * i], d, x.begin());
      if (!is_cut || is_cut(x) == 0) all.push_back(i);
    }
    return all;
  }
  Numbers mapped(const Map& map) const {
    const auto d = static_cast<std::size_t>(scene.dim);
    Numbers x;
    for (const std::size_t i : shown)
      for (std::size_t a = 0; a < d; ++a) {
        double sum = 0;
        for (std::size_t b = 0; b < d; ++b) sum += map[a][b] * origins.x0[d * i + b];
        x.push_back(sum);
      }
    return x;
  }
  SurfaceShape at(const Numbers& x) const { return surface.at(x, Numbers(shown.size(), 1), false); }
};

/// Area in 2D, enclosed volume in 3D, m^dim.
double measure(const SurfaceShape& shape, int dim) {
  double sum = 0;
  const auto point = [&](std::size_t k, std::size_t axis) {
    return shape.x[static_cast<std::size_t>(dim) * shape.triangle[k] + axis];
  };
  for (std::size_t k = 0; k < shape.triangle.size(); k += 3) {
    const auto way = [&](std::size_t corner, std::size_t axis) {
      return point(k + corner, axis) - point(k, axis);
    };
    const double z = way(1, 0) * way(2, 1) - way(1, 1) * way(2, 0);
    sum += dim == 2 ? 0.5 * std::abs(z) : z / 2 * (point(k, 2) + point(k + 1, 2) + point(k + 2, 2)) / 3;
  }
  return sum;
}

double determinant(int dim) {
  const double flat = stretch[0][0] * stretch[1][1] - stretch[0][1] * stretch[1][0];
  if (dim == 2) return flat;
  return stretch[2][2] * flat + stretch[2][0] * (stretch[0][1] * stretch[1][2]) -
         stretch[1][2] * stretch[2][1] * stretch[0][0];
}

Scene scene_of(const std::vector<Shape>& shapes, int dim = 2) {
  Scene scene = scene_of_shapes({shapes.front()}, dim, spacing);
  scene.bodies[0].shapes = shapes;
  return scene;
}

double length(const Numbers& segments) {
  double sum = 0;
  for (std::size_t k = 0; k < segments.size(); k += 4)
    sum += std::hypot(segments[k + 2] - segments[k], segments[k + 3] - segments[k + 1]);
  return sum;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the triangulation of a lattice fills its square, in 3D its cube") {
    for (const int dim : {2, 3}) {
      constexpr int n = 6;
      Numbers x;
      for (int i = 0; i < (dim == 2 ? n * n : n * n * n); ++i)
        for (int axis = 0, rest = i; axis < dim; ++axis, rest /= n) x.push_back(rest % n);
      const std::vector<std::uint32_t> all = delaunay(dim, x);
      double sum = 0;
      for (std::size_t k = 0; k < all.size(); k += static_cast<std::size_t>(dim) + 1) {
        const auto way = [&](std::size_t c, std::size_t axis) {
          return x[all[k + c] * static_cast<std::size_t>(dim) + axis] -
                 x[all[k] * static_cast<std::size_t>(dim) + axis];
        };
        const double flat = way(1, 0) * way(2, 1) - way(1, 1) * way(2, 0);
        if (dim == 2) {
          sum += std::abs(flat) / 2;
          continue;
        }
        const double a = way(2, 0) * way(3, 1) - way(2, 1) * way(3, 0);
        const double b = way(1, 0) * way(3, 1) - way(1, 1) * way(3, 0);
        sum += std::abs(flat * way(3, 2) - b * way(2, 2) + a * way(1, 2)) / 6;
      }
      CHECK(sum == Approx(std::pow(n - 1, dim)));
    }
    CHECK(delaunay(2, Numbers{0, 0, 1, 1}).empty());
  }

  TEST_CASE("a surface fills its body without gap or overlap under a linear deformation") {
    const Box square{{0, 0, 0}, {0.1, 0.06, 0}}, cube{{0, 0, 0}, {0.06, 0.05, 0.04}};
    struct Case {
      std::vector<Shape> shapes;
      int dim;
      double size;  // m^dim
    };
    for (const Case& each :
         {Case{{square}, 2, 0.006}, Case{{square, Box{{0.02, 0.06, 0}, {0.04, 0.15, 0}}}, 2, 0.0078},
          Case{{cube}, 3, 1.2e-4}, Case{{cube, Box{{0.02, 0.05, 0}, {0.04, 0.08, 0.04}}}, 3, 1.44e-4}}) {
      CAPTURE(each.dim);
      CAPTURE(each.shapes.size());
      const Covered body(scene_of(each.shapes, each.dim));
      const SurfaceShape shape = body.at(body.mapped(stretch));
      CHECK(measure(shape, each.dim) == Approx(determinant(each.dim) * each.size).epsilon(1e-9));
      CHECK(shape.loose.empty());
    }
  }

  TEST_CASE("a surface follows round faces, and leaves holes and slots open") {
    const Covered ring(scene_of({Ring{{0, 0, 0}, 0.1, 0.2}}));
    const double area = std::numbers::pi * (0.04 - 0.01);
    const SurfaceShape shape = ring.at(ring.mapped({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}));
    CHECK(measure(shape, 2) == Approx(area).epsilon(2e-3));  // chords replace the arcs
    CHECK(length(shape.outline) == Approx(2 * std::numbers::pi * 0.3).epsilon(2e-3));

    Scene fork = scene_of({Box{{0, 0, 0}, {0.09, 0.1, 0}}});
    fork.bodies[0].without = {Box{{0.04, 0.02, 0}, {0.05, 0.1, 0}}};
    const Covered body(fork);
    CHECK(measure(body.at(body.mapped(stretch)), 2) == Approx(determinant(2) * 0.0082).epsilon(1e-9));

    // inner corners stay open, and tips, which have no particle, are cut
    Chain corners;
    for (int k = 0; k < 10; ++k) {
      const double r = k % 2 == 0 ? 0.1 : 0.05, angle = (k + 0.5) * std::numbers::pi / 5;
      corners.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
    const Polygon polygon({corners});
    const Covered star(scene_of({polygon}));
    const double covered = measure(star.at(star.mapped(stretch)), 2) / (determinant(2) * polygon.measure(2));
    CHECK(covered < 1);
    CHECK(covered > 0.99);

    const Covered ball(scene_of({Disc{{0, 0, 0}, 0.06}}, 3));
    const SurfaceShape skin = ball.at(ball.mapped(stretch));
    CHECK(measure(skin, 3) ==
          Approx(determinant(3) * 4 / 3 * std::numbers::pi * std::pow(0.06, 3)).epsilon(0.05));
  }

  TEST_CASE("a surface of elements fills a ball and a cylinder, whose nodes can be far apart") {
    const double R = 0.06, exact = determinant(3) * std::numbers::pi * R * R;
    for (const int order : {1, 2}) {
      CAPTURE(order);
      Scene ball = scene_of({Disc{{0, 0, 0}, R}}, 3),
            rod = scene_of({Cylinder{{0, 0, 0}, {0, 0, 0.08}, R}}, 3);
      ball.element_order = rod.element_order = order;
      const Covered round(ball), straight(rod);
      const SurfaceShape skin = round.at(round.mapped(stretch)), hull = straight.at(straight.mapped(stretch));
      CHECK(measure(skin, 3) == Approx(exact * 4 / 3 * R).epsilon(0.05));
      CHECK(measure(hull, 3) == Approx(exact * 0.08).epsilon(0.05));
      CHECK(skin.loose.empty());
      CHECK(hull.loose.empty());
    }
  }

  TEST_CASE("values at faces continue a linear field, within the range of the particles") {
    const Covered body(scene_of({Box{{0, 0, 0}, {0.1, 0.06, 0}}}));
    const Numbers x = body.mapped({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
    Numbers value;
    for (std::size_t i = 0; i < body.shown.size(); ++i) value.push_back(3 * x[2 * i]);
    const SurfaceShape shape = body.surface.at(x, value, false);
    CHECK(shape.value.size() > value.size());
    const auto [low, high] = std::ranges::minmax(value);
    for (std::size_t k = 0; k < shape.value.size(); ++k) {
      CHECK(shape.value[k] >= low);
      CHECK(shape.value[k] <= high);
      if (shape.x[2 * k] > 0.02 && shape.x[2 * k] < 0.08)
        CHECK(shape.value[k] == Approx(3 * shape.x[2 * k]).epsilon(1e-9));
    }
    const SurfaceShape uniform = body.surface.at(x, value, true);
    for (const double v : uniform.value)
      CHECK(std::ranges::any_of(value, [v](double of) { return of == v; }));
  }

  TEST_CASE("a surface tears where neighbours separate, and single particles remain visible") {
    const Covered body(scene_of({Box{{0, 0, 0}, {0.1, 0.06, 0}}}));
    Numbers x = body.mapped({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
    const double whole = length(body.at(x).outline);
    CHECK(whole == Approx(0.32));
    CHECK(length(body.surface.undeformed()) == Approx(0.32));
    for (std::size_t i = 0; i < body.shown.size(); ++i)
      if (x[2 * i] > 0.05) x[2 * i] += 0.05;  // columns 6 spacings apart
    const SurfaceShape torn = body.at(x);
    CHECK(torn.loose.empty());
    CHECK(length(torn.outline) > whole + 0.03);
    CHECK(measure(torn, 2) > 0.8 * 0.006);
    CHECK(measure(torn, 2) < 0.006);

    x[0] -= 0.05;
    CHECK(body.at(x).loose == std::vector<std::uint32_t>{0});
    x[1] = std::nan("");
    CHECK(body.at(x).loose == std::vector<std::uint32_t>{0});
  }

  TEST_CASE("a surface ends at a cut") {
    const Covered half(scene_of({Box{{0, 0, 0}, {0.06, 0.06, 0.04}}}, 3),
                       [](const Point& x) { return static_cast<double>(x[1] < 0.029); });
    const SurfaceShape shape = half.at(half.mapped({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}));
    // between the first remaining layer, y = 0.035, and half-way to the removed one, y = 0.03
    CHECK(measure(shape, 3) > 0.06 * 0.04 * 0.025);
    CHECK(measure(shape, 3) < 0.06 * 0.04 * 0.03);
  }

  TEST_CASE("outlines of a followed body and of its initial shape are drawn relative to the body") {
    const Scene scene = scene_of({Box{{0, 0, 0}, {0.1, 0.06, 0}}});
    Drawing drawing;
    drawing.outline = Outlines::both;
    drawing.followed = 0;
    drawing.scene = std::make_shared<const Scene>(scene);
    const Origins origins = origins_of(scene);
    const Staging staging(drawing, origins);
    FrameView particles;
    Numbers x = origins.x0;
    for (std::size_t k = 0; k < x.size(); k += 2) x[k] += 7;
    const Numbers value(origins.size(), 1);
    particles.x = x, particles.value = value, particles.diameter = origins.diameter;
    const StagedParticles drawn = staging.completed(staging(particles));
    CHECK(drawn.triangle.empty());
    CHECK(drawn.x.size() == x.size());
    const auto left = [](const Numbers& of) {
      double least = 1e300;
      for (std::size_t k = 0; k < of.size(); k += 2) least = std::min(least, of[k]);
      return least;
    };
    CHECK(left(drawn.outline) == Approx(-0.05));
    CHECK(left(drawn.undeformed) == Approx(-7.05));
  }

  TEST_CASE("particles of hidden bodies are not drawn") {
    Scene scene = scene_of({Box{{0, 0, 0}, {0.1, 0.06, 0}}});
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].shapes = {Box{{1, 0, 0}, {1.05, 0.06, 0}}};
    Drawing drawing;
    drawing.hidden = {0};
    for (const bool surface : {false, true}) {
      if (surface) drawing.style = Style::surface, drawing.scene = std::make_shared<const Scene>(scene);
      const Origins origins = origins_of(scene);
      const Staging staging(drawing, origins);
      CHECK(staging.size() == 30);
      FrameView particles;
      const Numbers value(origins.size(), 1);
      particles.x = origins.x0, particles.value = value, particles.diameter = origins.diameter;
      const StagedParticles drawn = staging.completed(staging(particles));
      for (std::size_t k = 0; k < drawn.x.size(); k += 2) CHECK(drawn.x[k] > 0.9);
      CHECK(drawn.triangle.empty() == !surface);
    }
  }
}

}  // namespace of_surfaces
