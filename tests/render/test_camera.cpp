#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include "render/camera.hpp"
#include "tests/support/relative.hpp"

using namespace taut::render;
using taut::test::Approx;

namespace {

void check_near(const Vector& a, const Vector& b) {
  for (std::size_t k = 0; k < 3; ++k) CHECK(a[k] == Approx(b[k]).scale(1).epsilon(1e-12));
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a camera's axes are orthonormal and right-handed, and its up points upwards") {
    for (const Camera& camera : {Camera{}, Camera{.from = {3, 0.1, -7}, .up = {0, 2, 0}},
                                 Camera{.from = {-1e-3, 2e-3, 0}, .up = {1, 1, 1}}}) {
      const auto [right, up, back] = axes_of(camera);
      for (const Vector& axis : {right, up, back}) CHECK(dot(axis, axis) == Approx(1));
      check_near(cross(right, up), back);
      CHECK(dot(right, camera.up) == Approx(0));
      CHECK(dot(up, camera.up) > 0);
      CHECK(dot(back, camera.from) == Approx(std::sqrt(dot(camera.from, camera.from))));
    }
  }

  TEST_CASE("a camera that looks along its up vector uses y as up, or x where it looks along y") {
    check_near(axes_of({.from = {0, 0, 2}}).up, {0, 1, 0});
    check_near(axes_of({.from = {0, 0, 2}}).right, {1, 0, 0});
    check_near(axes_of({.from = {0, 3, 0}, .up = {0, -1, 0}}).up, {1, 0, 0});
  }

  TEST_CASE("an orbiting camera rotates around its up vector, then upwards, at constant distance") {
    const Camera camera{.from = {0, -2, 0}};
    check_near(orbited(camera, 90, 0).from, {2, 0, 0});
    check_near(orbited(camera, 0, 30).from, {0, -std::sqrt(3.0), 1});
    check_near(orbited(camera, 90, 30).from, {std::sqrt(3.0), 0, 1});
    check_near(orbited(orbited(camera, 25, 40), -25, 0).from, orbited(camera, 0, 40).from);
    CHECK(orbited(camera, 25, 40).up == camera.up);
  }

  TEST_CASE("lengths are true in parallel projection, and in perspective only in the front plane") {
    const View view{-1, 1, -0.5, 1.5};
    const Camera camera{.from = {0, -1, 0}, .field_of_view = 90, .front = 0.25};
    const Projection parallel({.from = {0, -1, 0}}, view), perspective(camera, view);
    check_near(parallel({0.3, 0.7, 0.4}).at, {0.3, 0.4, -0.7});
    check_near(perspective({0.3, -0.25, 0.4}).at, {0.3, 0.4, 0.25});
    const Projection::Projected seen = perspective({0.3, 0.75, 0.4});
    CHECK(seen.scale == Approx(0.5));
    check_near(seen.at, {0.15, 0.5 - 0.05, -0.75});
    CHECK(perspective({0, -2, 0}).scale < 0);
  }

  TEST_CASE("the projection of a short vector is the difference of its projected ends") {
    const View view{-1, 2, -0.5, 1.5};
    for (const double angle : {0.0, 40.0}) {
      const Projection projection({.from = {1, -2, 1}, .field_of_view = angle, .front = 1}, view);
      const Vector x{0.3, -0.2, 0.5}, way{2e-6, 1e-6, -3e-6};
      const Vector far = projection({x[0] + way[0], x[1] + way[1], x[2] + way[2]}).at;
      const Vector near = projection(x).at;
      const Vector seen = projection.project_vector(way, projection(x));
      for (std::size_t k = 0; k < 3; ++k)
        CHECK(seen[k] == Approx(far[k] - near[k]).scale(1e-6).epsilon(1e-4));
    }
  }
}
