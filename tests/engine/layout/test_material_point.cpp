#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "engine/layout/material_point.hpp"
#include "engine/scene/shapes/box.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double dp = 0.1;

std::vector<Point> lattice() {
  std::vector<Point> x;
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) x.push_back({i * dp, j * dp, 0});
  return x;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("material point: the weights fall as (1 − r²/reach²)²") {
    const double reach = 1.8 * dp;
    const std::vector<PointWeight> point = material_point(lattice(), 0, 25, {0, 0, 0}, reach, 2);
    REQUIRE(point.size() == 9);
    const auto W = [&](double r) { return std::pow(1 - r * r / (reach * reach), 2); };
    const double sum = W(0) + 4 * W(dp) + 4 * W(std::sqrt(2.0) * dp);
    for (const auto& [particle, weight] : point) {
      const Point x = lattice()[static_cast<std::size_t>(particle)];
      CHECK(weight == Approx(W(std::hypot(x[0], x[1])) / sum).epsilon(1e-12));
    }
  }

  TEST_CASE(
      "material point: weights sum to one, have no first moment, and belong to particles of the given range") {
    const std::vector<Point> x = lattice();
    for (const Point& at : {Point{0.03, -0.07, 0}, Point{2.5 * dp, 0.04, 0}}) {
      double one = 0, along = 0, across = 0;
      for (const auto& [particle, weight] : material_point(x, 0, 25, at, 2.6 * dp, 2)) {
        one += weight;
        along += weight * (x[static_cast<std::size_t>(particle)][0] - at[0]);
        across += weight * (x[static_cast<std::size_t>(particle)][1] - at[1]);
      }
      CHECK(one == Approx(1).epsilon(1e-12));
      CHECK(std::abs(along) < 1e-12 * dp);
      CHECK(std::abs(across) < 1e-12 * dp);
    }
    for (const auto& [particle, weight] : material_point(x, 5, 20, {0, 0, 0}, 2.6 * dp, 2)) {
      CHECK(particle >= 5);
      CHECK(particle < 20);
      CHECK(weight != 0);
    }
    CHECK(material_point(x, 10, 15, {0, 0, 0}, 2.6 * dp, 2).empty());
  }

  TEST_CASE("material point: a point on a face is interpolated between the particles of its cell") {
    Scene scene;
    scene.spacing = 0.99 * dp;  // the fitted spacing is dp
    scene.bodies.resize(1);
    scene.bodies[0].shapes = {Box{{-2 * dp, -2 * dp, 0}, {2 * dp, 2 * dp, 0}}};
    scene.bodies[0].on_boundary = true;
    const std::vector<Point> x = lattice();
    const auto point = [&](const Point& at) { return material_point(x, 0, 25, at, 2.6 * dp, scene, 0); };
    const auto corner = point({2 * dp, -2 * dp, 0});
    REQUIRE(corner.size() == 1);
    CHECK(corner[0].particle == 4);
    CHECK(corner[0].weight == 1);
    const auto inside = point({0.7 * dp, 2 * dp, 0});
    REQUIRE(inside.size() == 2);
    CHECK(inside[0].particle == 22);
    CHECK(inside[0].weight == Approx(0.3).epsilon(1e-12));
    CHECK(inside[1].weight == Approx(0.7).epsilon(1e-12));
    // beyond the face all neighbours count
    CHECK(point({2.5 * dp, 0, 0}).size() == material_point(x, 0, 25, {2.5 * dp, 0, 0}, 2.6 * dp, 2).size());
  }
}

}  // namespace of_this_file
