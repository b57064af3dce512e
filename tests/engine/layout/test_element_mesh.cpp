#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "engine/layout/element_nodes.hpp"
#include "engine/layout/surface_mesh.hpp"
#include "engine/scene/shapes/ellipse.hpp"
#include "engine/scene/shapes/polygon.hpp"
#include "engine/scene/shapes/turned.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double pi = std::numbers::pi;

Scene scene_of(int dim, int order, std::vector<Shape> shapes, double dp = 0.1) {
  Scene scene;
  scene.dim = dim;
  scene.spacing = dp;
  scene.element_order = order;
  scene.materials = {ring_rubber()};
  Body body;
  body.name = "body";
  body.shapes = std::move(shapes);
  scene.bodies = {body};
  return scene;
}

double volume_of(const InitialParticles& nodes) {
  return std::accumulate(nodes.V0.begin(), nodes.V0.end(), 0.0);
}

/// ∮ x·n dA/dim over the faces, by facets.
double enclosed(const InitialParticles& nodes) {
  double sum = 0;
  for (const MeshFacet& facet : boundary_of(nodes.mesh)) {
    const auto at = [&](std::size_t k) { return nodes.x[static_cast<std::size_t>(facet.node[k])]; };
    Point out{}, middle{};
    if (nodes.dim == 2) {
      out = {at(1)[1] - at(0)[1], at(0)[0] - at(1)[0], 0};
      for (std::size_t k = 0; k < 2; ++k) middle[k] = 0.5 * (at(0)[k] + at(1)[k]);
    } else {
      out = vector_area({at(0), at(1), at(2), at(3)});
      for (std::size_t k = 0; k < 3; ++k) middle[k] = 0.25 * (at(0)[k] + at(1)[k] + at(2)[k] + at(3)[k]);
    }
    for (std::size_t k = 0; k < 3; ++k) sum += (facet.inverted ? -1 : 1) * out[k] * middle[k] / nodes.dim;
  }
  return sum;
}

/// A traction on the region `where`.
struct Traction {
  InitialParticles nodes;
  std::vector<double> area;  // [node] m^(dim − 1)

  Traction(Scene scene, const Expression& where) {
    scene.bodies[0].loads = {{.where = where, .kind = Load::Kind::traction, .value = {}, .ramp = {}}};
    nodes = make_initial_particles(scene);
    area = load_weights(scene.bodies[0].loads[0], scene, nodes, 0);
  }
  double area_in(const Expression& region) const {
    double sum = 0;
    for (int i = 0; i < nodes.size(); ++i) sum += region(nodes.x[i]) != 0 ? area[i] : 0;
    return sum;
  }
  double whole() const { return area_in(constant(1)); }
};

Expression above(int axis, double least) {
  return [=](const Point& x) { return x[axis] > least ? 1.0 : 0.0; };
}

struct Case {
  int dim;
  Shape shape;
  double volume;  // exact
};

std::vector<Case> cases() {
  const auto ball = [](double r) { return 4 * pi / 3 * r * r * r; };
  return {{2, Box{{0.2, 0.1, 0}, {1.3, 0.8, 0}}, 0.77},
          {2, Disc{{2, 1, 0}, 0.7}, pi * 0.49},
          {2, Ellipse{{2, 1, 0}, {0.7, 0.5, 1}}, pi * 0.35},
          {2, Ring{{2, 1, 0}, 0.5, 0.8}, pi * (0.64 - 0.25)},
          {3, Box{{0.2, 0.1, 0}, {1.3, 0.8, 0.5}}, 0.385},
          {3, Disc{{2, 1, 0}, 0.7}, ball(0.7)},
          {3, Ring{{2, 1, 0}, 0.5, 0.8}, ball(0.8) - ball(0.5)},
          {3, Cylinder{{0, 0, 0}, {1, 0.5, 0.2}, 0.4}, pi * 0.16 * std::sqrt(1.29)},
          {3, Cylinder{{0, 0, 0}, {0, 0, 1}, 0.5, 0.3}, pi * 0.16},
          {3, Turned{Box{{0, 0, 0}, {1, 0.5, 0.5}}, Rotation{{0, 0, 1}, {}, 30}}, 0.25}};
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("element mesh: the volume of each shape is exact or converges, and nodal volumes are positive") {
    for (const Case& one : cases())
      for (const int order : {1, 2}) {
        CAPTURE(one.volume);
        CAPTURE(one.dim);
        CAPTURE(order);
        const auto error = [&](double dp) {
          const InitialParticles nodes = make_initial_particles(scene_of(one.dim, order, {one.shape}, dp));
          CHECK(std::ranges::min(nodes.V0) > 0);
          return std::abs(volume_of(nodes) / one.volume - 1);
        };
        const double coarse = error(0.1), fine = error(0.05);
        const bool is_straight = coarse < 1e-12;
        CHECK(is_straight == (one.shape.as<Box>() != nullptr || one.shape.as<Turned>() != nullptr));
        if (!is_straight) {
          CHECK(coarse < (order == 1 ? 0.05 : 0.003));
          CHECK(fine < (order == 1 ? 0.35 : 0.12) * coarse);  // convergence of orders 2 and 4
        }
      }
  }

  TEST_CASE("element mesh: facets point outwards and enclose the volume, also in mirrored bodies") {
    for (const Case& one : cases())
      for (const int order : {1, 2})
        for (const bool mirrored : {false, true}) {
          CAPTURE(one.volume);
          CAPTURE(order);
          Scene scene = scene_of(one.dim, order, {one.shape});
          scene.bodies[0].mirror[0] = mirrored;
          const InitialParticles nodes = make_initial_particles(scene);
          // facets are flat, elements of order 2 are not
          CHECK(enclosed(nodes) == relative(volume_of(nodes), order == 1 ? 1e-2 : 5e-2));
          if (one.dim == 2) CHECK(enclosed(nodes) > 0.9 * one.volume);
        }
  }

  TEST_CASE("element mesh: a union of boxes has grid lines through all faces, and cut-outs are empty") {
    for (const int order : {1, 2}) {
      Scene scene = scene_of(2, order, {Box{{0, 0, 0}, {1, 0.33, 0}}, Box{{0.7, -0.2, 0}, {1.27, 0.4, 0}}});
      scene.bodies[0].without = {Box{{0.9, 0, 0}, {1.0, 0.1, 0}}};
      const InitialParticles nodes = make_initial_particles(scene);
      CHECK(volume_of(nodes) == relative(0.33 + 0.57 * 0.6 - 0.3 * 0.33 - 0.01));
      CHECK(enclosed(nodes) == relative(volume_of(nodes)));
    }
  }

  TEST_CASE(
      "element mesh: jitter and shapes without a mesh are refused, and the message names shapes with a mesh") {
    const Polygon triangle({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
    const Scene scene = scene_of(2, 1, {triangle});
    CHECK_THROWS_WITH_AS(make_initial_particles(scene),
                         doctest::Contains("shapes with a mesh: a single disc, ellipse, ring"), SceneError);
    Scene both = scene_of(3, 2, {Disc{{}, 1}, Box{{0, 0, 0}, {2, 1, 1}}});
    CHECK_THROWS_WITH_AS(make_initial_particles(both), doctest::Contains("or boxes with unions and cut-outs"),
                         SceneError);
    Scene shaken = scene_of(2, 1, {Disc{{}, 1}});
    shaken.jitter.share = 0.1;
    CHECK_THROWS_WITH_AS(make_initial_particles(shaken), doctest::Contains("jitter"), SceneError);
  }

  TEST_CASE("element mesh: a region contains the nodes of the elements whose middles it contains") {
    Scene scene = scene_of(2, 1, {Box{{-0.3, 0, 0}, {1, 0.3, 0}}});
    scene.bodies[0].clamped = [](const Point& x) { return x[0] < 0 ? 1.0 : 0.0; };
    const InitialParticles nodes = make_initial_particles(scene);
    for (int i = 0; i < nodes.size(); ++i) CHECK(bool(nodes.clamped[i]) == (nodes.x[i][0] < 1e-9));
    scene.bodies[0].clamped = [](const Point& x) { return x[0] < -0.26 ? 1.0 : 0.0; };
    CHECK_THROWS_WITH_AS(make_initial_particles(scene), doctest::Contains("no element"), SceneError);
  }

  TEST_CASE("element mesh: a part that contains no middle of an element is refused") {
    for (const int order : {1, 2}) {
      CAPTURE(order);
      Scene scene = scene_of(2, order, {Box{{0, 0, 0}, {1, 0.4, 0}}});
      scene.materials.push_back(scene.materials[0]);
      const double size = 0.1 * order;
      const auto part_to = [&](double x) {
        scene.bodies[0].parts = {{1, [=](const Point& at) { return at[0] < x ? 1.0 : 0.0; }}};
      };
      part_to(0.51 * size);
      CHECK(std::ranges::count(make_initial_particles(scene).mesh.material, 1) == 4 / order);
      part_to(0.49 * size);
      for (const bool on_boundary : {false, true}) {
        scene.bodies[0].on_boundary = on_boundary;
        CHECK_THROWS_WITH_AS(make_initial_particles(scene), doctest::Contains("parts[0]: no element of body"),
                             SceneError);
      }
    }
  }

  TEST_CASE("element mesh: a traction acts on one face of its region, a force on the whole region") {
    for (const int order : {1, 2}) {
      const Scene scene = scene_of(3, order, {Box{{0, 0, 0}, {1, 0.4, 0.4}}});
      const Traction pull(scene, above(0, 0.9));
      CHECK(pull.whole() == relative(0.16));
      for (int i = 0; i < pull.nodes.size(); ++i) CHECK((pull.area[i] > 0) == (pull.nodes.x[i][0] > 0.999));
      const Load load{.where = above(0, 0.8), .kind = Load::Kind::force, .value = {}, .ramp = {}};
      const std::vector<double> volume = load_weights(load, scene, pull.nodes, 0);
      CHECK(std::accumulate(volume.begin(), volume.end(), 0.0) == relative(0.2 * 0.16));
    }
  }

  TEST_CASE(
      "element mesh: a traction on a face gives nodes of order 2 the weights 1/6, 2/3, 1/6 of each element") {
    const Traction edge(scene_of(2, 2, {Box{{0, 0, 0}, {1, 0.4, 0}}}), above(0, 0.9));
    const Traction face(scene_of(3, 2, {Box{{0, 0, 0}, {1, 0.4, 0.4}}}), above(0, 0.9));
    const auto along = [](double x) {  // m; elements of 0.2 m
      const long k = std::lround(x / 0.1);
      return k % 2 == 1 ? 0.2 * 2 / 3 : k == 0 || k == 4 ? 0.2 / 6 : 0.2 / 3;
    };
    for (int i = 0; i < edge.nodes.size(); ++i)
      if (edge.area[i] > 0) CHECK(edge.area[i] == relative(along(edge.nodes.x[i][1])));
    for (int i = 0; i < face.nodes.size(); ++i)
      if (face.area[i] > 0)
        CHECK(face.area[i] == relative(along(face.nodes.x[i][1]) * along(face.nodes.x[i][2])));
    CHECK(edge.whole() == relative(0.4));
    CHECK(face.whole() == relative(0.16));
  }

  TEST_CASE("element mesh: a traction on a region at two opposite faces acts on both faces") {
    for (const int dim : {2, 3})
      for (const int order : {1, 2}) {
        CAPTURE(dim);
        CAPTURE(order);
        const double face = dim == 2 ? 0.4 : 0.12;
        const Traction pull(scene_of(dim, order, {Box{{0, 0, 0}, {1, 0.4, 0.3}}}),
                            [](const Point& x) { return std::abs(x[0] - 0.5) > 0.4 ? 1.0 : 0.0; });
        CHECK(pull.area_in(above(0, 0.999)) == relative(face));
        CHECK(pull.area_in([](const Point& x) { return x[0] < 0.001 ? 1.0 : 0.0; }) == relative(face));
        CHECK(pull.whole() == relative(2 * face));
      }
  }

  TEST_CASE("element mesh: a traction at the end of a bar one or two spacings wide acts on the end alone") {
    for (const int order : {1, 2})
      for (const double width : {0.1, 0.2})
        for (const int dim : {2, 3}) {
          CAPTURE(order);
          CAPTURE(width);
          CAPTURE(dim);
          const int along = dim - 1;
          const Point end = dim == 2 ? Point{width, 1, 0} : Point{width, 0.3, 1};
          const Traction pull(scene_of(dim, order, {Box{{}, end}}), above(along, 0.9));
          CHECK(pull.whole() == relative(dim == 2 ? width : 0.3 * width));
          CHECK(pull.area_in(above(along, 0.999)) == relative(pull.whole()));
        }
  }

  TEST_CASE("element mesh: in a part one spacing thick a traction acts by halves on both sides") {
    const auto strip = [](const Point& x) { return std::abs(x[0] - 0.5) < 0.2 ? 1.0 : 0.0; };
    for (const int order : {1, 2}) {
      CAPTURE(order);
      const Traction plate(scene_of(2, order, {Box{{0, 0, 0}, {1, 0.1, 0}}}), strip);
      CHECK(plate.whole() == relative(0.4));
      CHECK(plate.area_in(above(1, 0.099)) == relative(0.2));
      const Traction bar(scene_of(3, order, {Box{{0, 0, 0}, {1, 0.1, 0.1}}}), strip);
      CHECK(bar.whole() == relative(0.04));
      const Traction thick(scene_of(2, order, {Box{{0, 0, 0}, {1, 0.2, 0}}}), strip);
      CHECK(thick.whole() == relative(0.8));
      CHECK(thick.area_in(above(1, 0.199)) == relative(0.4));
      const Scene square = scene_of(3, order, {Box{{0, 0, 0}, {1, 0.2, 0.2}}});
      CHECK_THROWS_WITH_AS(Traction(square, strip), doctest::Contains("meet at an edge"), SceneError);
      const Traction ring(scene_of(2, order, {Ring{{}, 0.5, 0.6}}), constant(1));
      CHECK(ring.whole() == relative(pi * 1.1, 0.01));
      CHECK(ring.area_in([](const Point& x) { return std::hypot(x[0], x[1]) < 0.501 ? 1.0 : 0.0; }) ==
            relative(pi * 0.5, 0.01));
    }
  }

  TEST_CASE("element mesh: a traction on a round face or the ends of a pipe acts on the whole face alone") {
    const auto around = [](double low, double high) {
      return [=](const Point& x) {
        const double r = std::hypot(x[0], x[1]);
        return low < r && r < high ? 1.0 : 0.0;
      };
    };
    const auto ends = [](double reach) {
      return [=](const Point& x) { return std::abs(x[2] - 0.5) > 0.5 - reach ? 1.0 : 0.0; };
    };
    struct Face {
      int dim;
      Shape shape;
      Expression region, face;
      double area;  // exact
    };
    const Cylinder pipe{{0, 0, 0}, {0, 0, 1}, 0.5, 0.3};
    const Face faces[] = {{2, Disc{{}, 0.7}, around(0.6, 1), around(0.699, 1), 2 * pi * 0.7},
                          {2, Ring{{}, 0.5, 0.8}, around(0.7, 1), around(0.799, 1), 2 * pi * 0.8},
                          {2, Ring{{}, 0.5, 0.8}, around(0, 0.6), around(0, 0.501), 2 * pi * 0.5},
                          {3, pipe, around(0.4, 1), around(0.499, 1), 2 * pi * 0.5},
                          {3, pipe, around(0, 0.4), around(0, 0.301), 2 * pi * 0.3},
                          {3, pipe, ends(0.1), ends(0.001), 2 * pi * 0.16}};
    for (const Face& f : faces)
      for (const int order : {1, 2}) {
        CAPTURE(f.area);
        CAPTURE(order);
        const Traction pull(scene_of(f.dim, order, {f.shape}), f.region);
        CHECK(pull.whole() == relative(f.area, 0.015));  // facets are flat
        CHECK(pull.area_in(f.face) == relative(pull.whole()));
      }
  }

  TEST_CASE("element mesh: shape functions reproduce the point at which they are evaluated") {
    for (const Case& one : cases())
      for (const int order : {1, 2}) {
        const InitialParticles nodes = make_initial_particles(scene_of(one.dim, order, {one.shape}));
        const Point at = nodes.mesh.middle[3];
        const std::vector<PointWeight> point = point_in_element(nodes, 0, at);
        REQUIRE(!point.empty());
        Point found{};
        for (const PointWeight& w : point)
          for (std::size_t k = 0; k < 3; ++k) found[k] += w.weight * nodes.x[w.particle][k];
        CHECK(distance_between(found, at, one.dim) < 1e-9);
        CHECK(point_in_element(nodes, 0, {9, 9, 9}).empty());
      }
  }
}

}  // namespace of_this_file
