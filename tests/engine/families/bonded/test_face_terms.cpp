#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/measures.hpp"
#include "engine/families/bonded/bonds.hpp"
#include "engine/families/bonded/face_terms.hpp"
#include "engine/methods/oenog.hpp"
#include "engine/scene/initial_particles.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

using namespace taut;
using namespace taut::test;

namespace {

/// A free plate in 3D of as many rows each way, of square cells of this size, m.
Scene free_plate(std::array<int, 3> rows, double dp, double nu) {
  Scene scene = small_solid_collision();
  scene.spacing = dp;
  scene.bodies.pop_back();
  scene.bodies[0].shapes = {Box{{0, 0, 0}, {rows[0] * dp, rows[1] * dp, rows[2] * dp}}};
  scene.bodies[0].velocity = {};
  scene.materials[0].poisson_ratio = nu;
  return scene;
}

}  // namespace

TEST_SUITE("term") {
  TEST_CASE(
      "faces: what is cancelled there is nothing of a homogeneous strain, and outwards of another one") {
    for (const double nu : {0.0, 0.3, 0.49}) {
      CAPTURE(nu);
      Scene scene = small_clamped_plate();
      scene.bodies.pop_back();
      scene.materials[0].poisson_ratio = nu;
      const InitialParticles initial = make_initial_particles(scene);
      const Bonds bonds = make_bonds(scene, initial, oenog.h_over_dp * scene.spacing);
      std::map<long, std::array<double, 2>> of_column;  // Σ w, Σ w |y|
      for (const FaceTerm& term : bonds.face_terms) {
        if (std::abs(term.d[0]) < std::abs(term.d[1])) continue;  // of the ends
        CHECK(std::abs(term.d[1]) < 1e-12 * std::abs(term.d[0]));
        const Point& x = initial.x[term.i];
        auto& sums = of_column[std::lround(x[0] / scene.spacing * 2)];
        sums[0] += term.weight, sums[1] += term.weight * std::abs(x[1]);
      }
      CHECK(of_column.size() > 5);
      const double thinner = nu / (1 - nu), c = 1.1 * 5 / 16 * (1.5 - thinner - 1.5 * thinner * thinner);
      for (const auto& [x, sums] : of_column) {
        CHECK(std::abs(sums[0]) < 1e-15);
        CHECK(sums[1] == relative(-2 * 0.8 * c * scene.spacing, 1e-9));
      }
    }
    Scene disc = small_clamped_plate();
    disc.bodies.pop_back();
    disc.bodies[0].shapes = {Disc{{}, 0.018, RoundLayout::spaced}};
    const InitialParticles of_disc = make_initial_particles(disc);
    CHECK(make_bonds(disc, of_disc, oenog.h_over_dp * disc.spacing)
              .face_terms.empty());  // more than the eight nearest
  }

  TEST_CASE("faces: in 3D what is cancelled of lines and areas is nothing of a homogeneous strain") {
    for (const double nu : {-0.4, 0.0, 0.3, 0.49}) {
      CAPTURE(nu);
      constexpr double dp = 0.001;
      const Scene scene = free_plate({15, 15, 6}, dp, nu);
      const InitialParticles initial = make_initial_particles(scene);
      struct Sums {
        double weight = 0, times_depth = 0;
        int terms = 0;
      };
      std::map<std::array<int, 3>, Sums> lines;  // of the middle column's lower half, by the direction
      Sums areas;
      for (const FaceTerm& term : make_bonds(scene, initial, 0.9 * dp).face_terms) {
        const Point& X = initial.x[term.i];
        if (std::abs(X[0] - 7.5 * dp) > 0.1 * dp || std::abs(X[1] - 7.5 * dp) > 0.1 * dp || X[2] > 3 * dp)
          continue;
        std::array<int, 3> d;
        for (int k = 0; k < 3; ++k) d[k] = static_cast<int>(std::lround(term.d[k] / dp));
        if (d[0] < 0 || (d[0] == 0 && d[1] < 0)) d = {-d[0], -d[1], -d[2]};
        if (term.across) CHECK(std::abs(d[2]) == 1);
        Sums& sums = term.across ? areas : lines[d];
        sums.weight += term.weight, sums.times_depth += term.weight * X[2] / dp, ++sums.terms;
      }
      const double thinner = nu / (1 - nu);
      CHECK(areas.terms == 3);
      CHECK(std::abs(areas.weight) < 1e-15);
      CHECK(areas.times_depth == relative((1 - 5 * thinner) * (1 + 3 * thinner) / 40, 1e-9));
      CHECK(lines.size() == 4);
      for (const auto& [d, sums] : lines) {
        CHECK(d[2] == 0);
        CHECK(std::abs(sums.weight) < 1e-15);
        CHECK(sums.times_depth == relative(1.0 / 30, 1e-9));
      }
    }
  }

  TEST_CASE(
      "faces: in 3D there are terms on the faces of plates of a lattice, a thickness from their edges") {
    constexpr double dp = 0.001;
    const auto terms = [](const Scene& scene) {
      return make_bonds(scene, make_initial_particles(scene), 0.9 * scene.spacing).face_terms.size();
    };
    Scene plate = free_plate({12, 11, 3}, dp, 0.3);
    // of each face all but the three outermost rows and the edge; nine terms on each of three layers
    CHECK(terms(plate) == 2 * (12 - 8) * (11 - 8) * 3 * 9);
    CHECK(terms(free_plate({12, 12, 12}, dp, 0.3)) == 0);
    plate.bodies[0].on_boundary = true;
    CHECK(terms(plate) == 0);
    plate.bodies[0].on_boundary = false;
    plate.jitter.share = 0.05;
    CHECK(terms(plate) == 0);
  }
}

TEST_SUITE("convergence") {
  TEST_CASE("faces: three layers bend a free plate in its right time, whatever Poisson's ratio") {
    struct Plate {
      double nu;
      bool twisted;
      double period;  // s, by h² from five and eight layers
    };
    // 0.8, 0.4 and 0.1 %; without the terms 4.4, 8.4 and 3.2 %
    for (const Plate& plate :
         {Plate{0, true, 4.5716e-3}, Plate{0, false, 3.1827e-3}, Plate{0.3975, false, 2.5519e-3}}) {
      CAPTURE(plate.nu);
      CAPTURE(plate.twisted);
      constexpr double side = 0.1, thick = 0.01;
      Scene scene = free_plate({30, 30, 3}, thick / 3, plate.nu);
      scene.materials[0].density = 1000, scene.materials[0].youngs_modulus = 1e8;
      scene.bodies[0].velocity[2] = [twisted = plate.twisted](const Point& X) {
        const double x = X[0] - side / 2, y = X[1] - side / 2;
        return 0.04 / (side * side) * (twisted ? x * y : x * x + y * y - side * side / 6);
      };
      scene.probes = {make_probe("plate", Probe::Kind::displacement)};
      scene.probes[0].at = {side, plate.twisted ? side : side / 2, thick / 2};
      scene.probes[0].axis = 2;
      Measure period;
      period.kind = "period";
      period.probes = {scene.probes[0].name};
      scene.measures = {period};
      const auto simulation = make_simulation(scene, with_method("oenog"));
      simulation->advance_to(1.8 * plate.period);
      const auto result = measure(scene, simulation->series(), "neo_hookean");
      REQUIRE(result[0].value);
      CHECK(std::abs(*result[0].value / plate.period - 1) < 0.012);
    }
  }
}
