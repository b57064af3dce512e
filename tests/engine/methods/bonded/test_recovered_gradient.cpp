
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/bonded/layout/recovered_gradient.hpp"
#include "engine/methods/bonded/methods.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double H = 0.02, L = 0.06;

Scene block(int across, double length = L) {
  Scene scene;
  scene.name = "block";
  scene.spacing = H / across;
  scene.until = 1;
  scene.materials = {{"elastic", /*ρ0*/ 1000, /*E*/ 2e6, /*ν*/ 0.3}};
  Body body;
  body.name = "block";
  body.shapes = {Box{{-length / 2, -H / 2, 0}, {length / 2, H / 2, 0}}};
  scene.bodies = {body};
  return scene;
}

Scene block_of_two() {
  Scene scene = block(10);
  scene.materials.push_back({"soft", 900, 4e6, 0.3});
  scene.bodies[0].parts = {{1, [](const Point& x) { return x[0] > 0 ? 1.0 : 0.0; }}};
  return scene;
}

RecoveredGradient recovered(const Scene& scene, const InitialParticles& initial, bool halved = false) {
  std::vector<int> id(initial.size());
  std::iota(id.begin(), id.end(), 0);
  const double h = oenog.h_over_dp * scene.spacing;
  Constraints constraints(initial.size());
  for (int i = 0; i < initial.size(); ++i)
    if (initial.clamped[i]) constraints[i] = Constraint::clamped;
  return recovered_gradient(initial, constraints, initial.drive, id, scene.spacing, greatest_bond_reach * h,
                            /*threads*/ 1, halved);
}

/// Greatest error over all monomials of `degree`, with lengths in dp.
template <class Rows, class Gradient>
double error(const Rows& rows, const Gradient& g, const InitialParticles& initial, int i, double dp,
             int degree) {
  double greatest = 0;
  for (int power = 0; power <= degree; ++power) {
    for (std::size_t k = 0; k < 2; ++k) {
      double sum = 0;
      for (int b = rows.begin[i]; b < rows.begin[i + 1]; ++b) {
        const Point &X_j = initial.x[rows.j[b]], &X_i = initial.x[i];
        sum += std::pow((X_j[0] - X_i[0]) / dp, power) * std::pow((X_j[1] - X_i[1]) / dp, degree - power) *
               g(b)[k] * dp;
      }
      const double should = degree == 1 && power == (k == 0 ? 1 : 0) ? 1 : 0;
      greatest = std::max(greatest, std::abs(sum - should));
    }
  }
  return greatest;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE(
      "recovered gradient: rows are exact for quadratic fields, and bonds nearly so for particles without a row") {
    for (const Scene& scene : {block(10), block_of_two(), small_collision(), small_clamped_plate()}) {
      CAPTURE(scene.name);
      const InitialParticles initial = make_initial_particles(scene);
      const RecoveredGradient rows = recovered(scene, initial);
      const Bonds bonds = make_bonds(scene, initial, oenog.h_over_dp * scene.spacing);
      int shown = 0;
      double worst = 0, own = 0;
      for (int i = 0; i < initial.size(); ++i) {
        const int begin = rows.begin[i], end = rows.begin[i + 1];
        shown += end > begin;
        if (initial.clamped[i]) continue;
        for (const int degree : {1, 2}) {
          if (end > begin)
            worst = std::max(
                worst, error(
                           rows, [&](int b) { return rows.of(i, b); }, initial, i, scene.spacing, degree));
          else
            own = std::max(own, error(
                                    bonds, [&](int b) { return bonds.gradient(i, b); }, initial, i,
                                    scene.spacing, degree));
        }
        for (int b = begin; b < end; ++b) {
          CHECK(initial.material[rows.j[b]] == initial.material[i]);
          CHECK(initial.clamped[rows.j[b]] == initial.clamped[i]);
        }
      }
      CHECK(worst < 1e-9);
      CHECK(own < 1e-3);
      CHECK(shown > 0);
    }
  }

  TEST_CASE("recovered gradient: the compact form equals the full one rounded to single precision") {
    const Scene cube = jittered(small_clamped_block(), 0.2);
    const InitialParticles initial = make_initial_particles(cube);
    const RecoveredGradient whole = recovered(cube, initial), half = recovered(cube, initial, true);
    CHECK(half.j == whole.j);
    CHECK(half.row == whole.row);
    CHECK(half.g.empty());
    REQUIRE(whole.g.size() > 0);
    const std::vector<float> rounded(whole.g.begin(), whole.g.end());
    CHECK(half.halved == rounded);
  }

  TEST_CASE("recovered gradient: a larger cube has more rows but no more distinct rows") {
    std::size_t entries = 0, numbers = 0;
    for (const int across : {10, 14}) {
      Scene cube = block(across, H);
      cube.dim = 3;
      cube.spacing = 1e-3;
      cube.bodies[0].shapes = {Box{{0, 0, 0}, {across * 1e-3, across * 1e-3, across * 1e-3}}};
      const RecoveredGradient rows = recovered(cube, make_initial_particles(cube));
      CHECK(rows.j.size() > entries);
      if (numbers > 0) CHECK(rows.g.size() == numbers);
      entries = rows.j.size(), numbers = rows.g.size();
    }
  }

  TEST_CASE(
      "recovered gradient: only layers beside another material are marked as lying between two materials") {
    const double dp = H / 5;
    Scene scene = block(5, 14 * dp);
    scene.dim = 3;
    scene.bodies[0].shapes = {Box{{-7 * dp, -H / 2, -H / 2}, {7 * dp, H / 2, H / 2}}};
    CHECK(recovered(scene, make_initial_particles(scene)).between.empty());
    scene.materials.push_back({"soft", 900, 4e6, 0.3});
    scene.bodies[0].parts = {{1, [](const Point& x) { return x[0] > 0 ? 1.0 : 0.0; }}};
    const InitialParticles initial = make_initial_particles(scene);
    const RecoveredGradient rows = recovered(scene, initial);
    REQUIRE(rows.between.size() == static_cast<std::size_t>(initial.size()));
    for (int i = 0; i < initial.size(); ++i) CHECK(rows.between[i] == (std::abs(initial.x[i][0]) < dp));
  }

  TEST_CASE(
      "recovered gradient: in a body of two layers rows are exact for linear fields only, in one layer there are none") {
    Scene thin = block(2);
    InitialParticles initial = make_initial_particles(thin);
    RecoveredGradient rows = recovered(thin, initial);
    for (int i = 0; i < initial.size(); ++i) {
      REQUIRE(rows.begin[i + 1] > rows.begin[i]);
      CHECK(error(
                rows, [&](int b) { return rows.of(i, b); }, initial, i, thin.spacing, 1) < 1e-9);
      CHECK(error(
                rows, [&](int b) { return rows.of(i, b); }, initial, i, thin.spacing, 2) > 0.1);
    }
    thin = block(1);
    initial = make_initial_particles(thin);
    rows = recovered(thin, initial);
    CHECK(rows.j.empty());
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("oenog: the stress of an imposed bending is exact at faces and corners") {
    const double kappa = 1e3 / H, step = 1e-9;  // too short for motion by forces
    for (const double rate : {1.0, -1.0}) {
      Scene scene = block(5, H);
      // pure bending: u = t κ (x y, −(x² + m y²)/2), m = ν/(1 − ν)
      const double m = 0.3 / 0.7, E = 2e6 / (1 - 0.09);
      scene.bodies[0].velocity[0] = [=](const Point& X) { return rate * kappa * X[0] * X[1]; };
      scene.bodies[0].velocity[1] = [=](const Point& X) {
        return -0.5 * rate * kappa * (X[0] * X[0] + m * X[1] * X[1]);
      };
      Settings settings = with_method("oenog");
      settings.step = step;
      const Snapshot now = state_after(1, scene, settings);
      CHECK(now.time == step);
      const double scale = E * kappa * now.time * H / 2;
      for (std::size_t i = 0; i < now.size(); ++i) {
        const StressTensor sigma = now.stress(i);
        CHECK(sigma.xx / scale == Approx(rate * now.x0[2 * i + 1] / (H / 2)).scale(1).epsilon(1e-3));
        CHECK(std::abs(sigma.yy) < 1e-3 * scale);
        CHECK(std::abs(sigma.xy) < 1e-3 * scale);
      }
    }
  }

  TEST_CASE("oenog: the stress beside a driven end is exact, also if the end is released later") {
    const double dp = H / 5, rate = 1e3, step = 1e-9;
    for (const int variant : {0, 1, 2, 3, 4, 5, 6, 7}) {
      const int dim = variant % 2 == 0 ? 2 : 3;
      const bool grip_of_steel = variant / 2 % 2 == 1, ends_before_run = variant / 4 == 1;
      CAPTURE(dim);
      CAPTURE(grip_of_steel);
      CAPTURE(ends_before_run);
      // bonds end at the face of a driven region, but at the first particles of a region released later
      const double kink = (ends_before_run ? 4.5 : 4) * dp;
      Scene scene = block(5, 14 * dp);
      scene.dim = dim;
      if (dim == 3) scene.bodies[0].shapes = {Box{{-7 * dp, -H / 2, -H / 2}, {7 * dp, H / 2, H / 2}}};
      if (grip_of_steel) {
        scene.materials.push_back({"steel", 7800, 2e8, 0.3});
        scene.bodies[0].parts = {{1, [=](const Point& X) { return X[0] > 4 * dp ? 1.0 : 0.0; }}};
      }
      Drive still;
      still.where = [=](const Point& X) { return X[0] > 4 * dp ? 1.0 : 0.0; };
      if (ends_before_run) still.until = 2 * step;
      scene.bodies[0].drives = {still};
      scene.bodies[0].velocity[0] = [=](const Point& X) { return rate * std::min(X[0] - kink, 0.0); };
      Settings settings = with_method("oenog");
      settings.step = step;
      const Snapshot now = state_after(1, scene, settings);
      const double M = 2e6 * 0.7 / (1.3 * 0.4);
      for (std::size_t i = 0; i < now.size(); ++i) {
        const double last = ends_before_run && grip_of_steel ? kink - dp : kink;
        const double should = now.x0[dim * i] < last + 0.1 * dp ? 1 : 0;
        CHECK(now.stress(i).xx / (M * rate * step) == Approx(should).scale(1).epsilon(1e-3));
      }
    }
  }
}

}  // namespace of_this_file
