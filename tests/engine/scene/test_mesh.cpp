#include <vector>

#include <doctest/doctest.h>

#include "engine/scene/shapes/mesh.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

void add_cube(Triangles& mesh, double low) {
  const int first = static_cast<int>(mesh.points.size());
  for (unsigned k = 0; k < 8; ++k)
    mesh.points.push_back({low + (k & 1), low + (k >> 1 & 1), low + (k >> 2 & 1)});
  constexpr int sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& [a, b, c, d] : sides) {
    mesh.corners.push_back({first + a, first + b, first + c});
    mesh.corners.push_back({first + a, first + c, first + d});
  }
}

bool is_in_cube(const Point& x, double low, double beyond) {
  bool in = true;
  for (const double component : x) in = in && component > low - beyond && component < low + 1 + beyond;
  return in;
}

/// Many points lie exactly on faces, edges and diagonals.
template <class Check>
void at_lattice(const Check& check) {
  for (int i = -2; i <= 14; ++i)
    for (int j = -2; j <= 14; ++j)
      for (int k = -2; k <= 14; ++k) check(Point{i / 8.0, j / 8.0, k / 8.0});
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE(
      "a mesh of a cube contains the points of the cube, also if the line above a point meets edges or corners") {
    Triangles triangles;
    add_cube(triangles, 0);
    CHECK(faults_of(triangles).open == 0);
    const Mesh cube(triangles);
    CHECK(cube.measure(3) == relative(1));
    int wrong = 0;
    at_lattice([&](const Point& x) {
      for (const double tolerance : {1e-9, -1e-9, 0.2, -0.2}) {
        const bool in = is_in_cube(x, 0, tolerance);
        const bool beside = tolerance == 0.2 && in && !is_in_cube(x, 0, 1e-9);
        wrong += !beside && cube.holds(x, 3, tolerance) != in;
      }
    });
    CHECK(wrong == 0);
  }

  TEST_CASE("a point on the common face of two cubes is in exactly one of them") {
    Triangles left, both;
    add_cube(left, 0);
    add_cube(both, 0);
    for (Point& x : both.points) x[0] += 1;
    const Mesh a(left), b(both);
    int wrong = 0;
    at_lattice([&](const Point& x) {
      if (x[0] == 1 && is_in_cube({0.5, x[1], x[2]}, 0, -1e-9)) wrong += a.holds(x, 3, 0) == b.holds(x, 3, 0);
    });
    CHECK(wrong == 0);
  }

  TEST_CASE("parts of a mesh may overlap, and a shifted mesh contains the shifted points") {
    Triangles triangles;
    add_cube(triangles, 0);
    add_cube(triangles, 0.5);
    Mesh mesh(triangles);
    int wrong = 0;
    const auto look = [&](double by) {
      at_lattice([&](const Point& x) {
        wrong += mesh.holds({x[0], x[1] + by, x[2]}, 3, 1e-9) !=
                 (is_in_cube(x, 0, 1e-9) || is_in_cube(x, 0.5, 1e-9));
      });
    };
    look(0);
    mesh.shift(1, 3);
    look(3);
    CHECK(wrong == 0);
    CHECK(mesh.bounds().high[1] == relative(4.5));
  }

  TEST_CASE("open edges, and edges whose triangles face opposite sides, are counted") {
    Triangles mesh;
    add_cube(mesh, 0);
    Triangles turned = mesh;
    std::swap(turned.corners[0][0], turned.corners[0][1]);
    CHECK(faults_of(turned).open == 0);
    CHECK(faults_of(turned).turned == 3);
    mesh.corners.pop_back();
    CHECK(faults_of(mesh).open == 3);
  }
}

}  // namespace of_this_file
