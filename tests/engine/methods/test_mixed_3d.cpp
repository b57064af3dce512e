
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/methods/tl_mixed/corrected_laplacian.hpp"
#include "engine/methods/tl_mixed/methods.hpp"
#include "engine/methods/tl_mixed/momentum_projection.hpp"
#include "engine/solver/initial_pairs.hpp"
#include "tests/engine/dense.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

using V3 = Vec<double, 3>;
using M3 = Mat<double, 3>;
using Wendland = Kernel<KernelName::wendland_c2>;
constexpr double pi = std::numbers::pi;

/// n³ particles, dp = 1.
struct Cube {
  std::vector<V3> X;
  std::vector<double> V;
  InitialPairs<3> pairs;
  std::vector<double> laplacian;

  Cube(int n, double h) : V(n * n * n, 1) {
    InitialParticles initial;
    initial.dim = 3;
    initial.body.resize(n * n * n);
    for (int i = 0; i < n * n * n; ++i) {
      X.push_back({1.0 * (i % n), 1.0 * (i / n % n), 1.0 * (i / (n * n))});
      initial.x.push_back({X[i][0], X[i][1], X[i][2]});
    }
    pairs = make_initial_pairs<Wendland>(initial_neighbors(initial, reach_of_pairs<Wendland>(h)), X, V, h,
                                         GradientCorrection::corrected);
    laplacian = corrected_laplacian<Wendland>(pairs, X, V, h, 1);
  }
  int neighbors(int i) const { return pairs.begin[i + 1] - pairs.begin[i]; }
  int middle() const {
    const V3 centre = 0.5 * X.back();
    int best = 0;
    for (int i = 0; i < pairs.size(); ++i) {
      const V3 d = X[i] - centre, to_best = X[best] - centre;
      if (dot(d, d) < dot(to_best, to_best)) best = i;
    }
    return best;
  }

  /// dp² L̂(k) of the wave cos(k·X).
  double symbol(int i, const V3& k) const {
    double sum = 0;
    for (int p = pairs.begin[i]; p < pairs.begin[i + 1]; ++p)
      sum += laplacian[p] * (std::cos(dot(k, X[pairs.j[p]] - X[i])) - 1);
    return sum;
  }
  /// dp |∇̂(k)| of the wave sin(k·X).
  double gradient_symbol(int i, const V3& k) const {
    V3 sum{};
    for (int p = pairs.begin[i]; p < pairs.begin[i + 1]; ++p)
      sum += std::sin(dot(k, X[pairs.j[p]] - X[i])) * pairs.k[p];
    const V3 gradient = pairs.B[i] * sum;
    return std::sqrt(dot(gradient, gradient));
  }
};

/// Greatest stable step of two-stage Runge–Kutta for du/dt = (−d ± i w) u.
double greatest_step(double d, double w) {
  const auto grows = [&](double dt) {
    const double a = -d * dt, b = w * dt;
    return std::hypot(1 + a + (a * a - b * b) / 2, b + a * b) > 1 + 1e-12;
  };
  double low = 0, high = 10;
  for (int k = 0; k < 60; ++k) (grows((low + high) / 2) ? high : low) = (low + high) / 2;
  return low;
}

Scene pressed_block(double lambda) {
  Scene scene;
  scene.name = "pressed-block";
  scene.dim = 3;
  scene.spacing = 0.001;
  scene.materials = {ring_rubber()};
  Body block;
  block.name = "block";
  block.shapes = {Box{{0, 0, 0}, {0.005, 0.005, 0.005}}};
  block.displacement[0] = [=](const Point& x) { return (lambda - 1) * x[0]; };
  scene.bodies = {block};
  return scene;
}

Scene sprung_block() {
  Scene scene = pressed_block(1.2);
  scene.bodies[0].displacement[1] = [](const Point& x) { return 0.2 * x[2]; };
  return scene;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("JST: zigzags on a 3D lattice have the tabulated Laplacians") {
    struct Row {
      double h;
      int neighbors;
      double along, plane, space;  // dp² L̂ of (π,0,0), (π,π,0), (π,π,π)
    };
    for (const Row& row : {Row{0.87, 26, -4.00, -6.28, -2.81}, Row{0.95, 26, -4.00, -4.26, -1.01},
                           Row{1.05, 32, -4.00, -2.29, -0.64}, Row{1.2, 56, -2.31, -0.55, -0.38},
                           Row{1.3, 80, -1.42, -0.21, -0.36}}) {
      CAPTURE(row.h);
      const Cube cube(9, row.h);
      const int i = cube.middle();
      CHECK(cube.neighbors(i) == row.neighbors);
      CHECK(std::abs(cube.symbol(i, {pi, 0, 0}) - row.along) < 0.006);
      CHECK(std::abs(cube.symbol(i, {pi, pi, 0}) - row.plane) < 0.006);
      CHECK(std::abs(cube.symbol(i, {pi, pi, pi}) - row.space) < 0.006);
      CHECK(std::abs(cube.gradient_symbol(i, {pi, pi, pi})) < 1e-14);
    }
  }

  TEST_CASE("JST: in 3D every zigzag decays at the default h, and the default step is stable") {
    const Cube cube(7, pf_jst.h_over_dp_3d);
    const int i = cube.middle();
    double slowest = 1e9, shortest = 1e9, steepest = 0;
    constexpr int n = 12;
    for (int a = 0; a <= n; ++a) {
      for (int b = 0; b <= a; ++b) {
        for (int c = 0; c <= b; ++c) {
          const V3 k{pi * a / n, pi * b / n, pi * c / n};
          const double L = cube.symbol(i, k), along = cube.gradient_symbol(i, k);
          const double decay = L * L / 8;  // ε₄ = 1/8, in units of c/dp
          steepest = std::max(steepest, along);
          if (a == n) slowest = std::min(slowest, decay);
          shortest = std::min(shortest, greatest_step(decay, along));
        }
      }
    }
    CHECK(slowest == relative(0.99, 0.01));
    CHECK(steepest == relative(1.36, 0.01));
    CHECK(shortest == relative(0.405, 0.01));
    CHECK(pf_jst.cfl * pf_jst.h_over_dp_3d < shortest);
  }

  TEST_CASE("JST: the Laplacian in a cube is exact except at corners, where linear fields still give 0") {
    const Cube cube(5, pf_jst.h_over_dp_3d);
    int corners = 0;
    const LaplacianLanes<3> of_four = with_laplacian(cube.pairs, cube.laplacian, cube.V, 1);
    Columns<3> U;
    U.resize(cube.pairs.size());
    for (int i = 0; i < cube.pairs.size(); ++i) {
      const V3& X = cube.X[i];
      U[0][i] = 1, U[1][i] = 3 + X[0] - 2 * X[1] + X[2], U[2][i] = dot(X, X);
    }
    for (int i = 0; i < cube.pairs.size(); ++i) {
      const Vec<double, 3> L =
          lane_of(differences_and_laplacian(of_four.view(), U, i / lanes).laplacian, i % lanes);
      CHECK(L[0] == 0);
      CHECK(std::abs(L[1]) < 1e-12);
      if (cube.neighbors(i) > 7)
        CHECK(L[2] == relative(6, 1e-11));
      else
        ++corners;
      for (int p = cube.pairs.begin[i]; p < cube.pairs.begin[i + 1]; ++p)
        CHECK(std::abs(cube.laplacian[p]) < 10);
    }
    CHECK(corners == 8);
  }

  TEST_CASE("JST: the spectral radius of the biharmonic term is the greatest eigenvalue of its matrix") {
    const Cube cube(4, pf_jst.h_over_dp_3d);
    const int n = cube.pairs.size();
    Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i)
      for (int p = cube.pairs.begin[i]; p < cube.pairs.begin[i + 1]; ++p)
        L(i, cube.pairs.j[p]) += cube.laplacian[p], L(i, i) -= cube.laplacian[p];
    const double greatest = eigenvalues(L.transpose() * L)[n - 1];
    const LaplacianLanes<3> of_four = with_laplacian(cube.pairs, cube.laplacian, cube.V, 1);
    CHECK(greatest > 40);
    CHECK(biharmonic_spectral_radius(of_four.view(), n, 1) == relative(greatest, 0.01));
    CHECK(biharmonic_spectral_radius(of_four.view(), n, 1) ==
          biharmonic_spectral_radius(of_four.view(), n, 3));
  }

  TEST_CASE("JST: steps on jittered particles are more than half as long as on the lattice") {
    const auto step = [](const Scene& scene) {
      const auto simulation = make_simulation(scene, with_method("pf-jst"));
      make_steps(*simulation, 1);
      return simulation->time();
    };
    for (const Scene& scene : {oscillating_plate(0.01, 5), pressed_block(1)})
      for (const double share : {0.05, 0.1, 0.2}) {
        CAPTURE(scene.dim);
        CAPTURE(share);
        CHECK(step(jittered(scene, share)) > 0.5 * step(scene));
      }
  }

  TEST_CASE("projection: in 3D the result is the nearest field without force and torque") {
    const Cube cube(4, 0.87);
    std::vector<V3> a, Z;
    for (const V3& X : cube.X) {
      a.push_back({std::sin(3 * X[0]) + 1, std::cos(X[0] * X[1]) + 4 * X[2], X[0] * X[1] - X[2]});
      Z.push_back({X[0] + 0.1 * X[1], X[1] + 7, 2 * X[2]});
    }
    const std::vector<V3> before = a;
    Columns<3> columns;
    columns.resize(cube.pairs.size() + lanes);
    for (int i = 0; i < cube.pairs.size(); ++i)
      for (int k = 0; k < 3; ++k) columns[k][i] = a[i][k];
    project_on_momenta(columns, Z.data(), cube.V.data(), 0, cube.pairs.size());
    for (int i = 0; i < cube.pairs.size(); ++i) a[i] = {columns[0][i], columns[1][i], columns[2][i]};
    V3 force{}, torque{}, torque_before{};
    double along = 0, size = 0, scale = 0;
    for (int i = 0; i < cube.pairs.size(); ++i) {
      const V3 d = a[i] - before[i];
      force += a[i];
      torque += cross(Z[i], a[i]);
      torque_before += cross(Z[i], before[i]);
      along += dot(d, a[i]);  // the change is orthogonal to all admissible fields
      size += dot(d, d);
      scale += std::sqrt(dot(before[i], before[i]));
    }
    for (int k = 0; k < 3; ++k) {
      CHECK(std::abs(force[k]) < 1e-13 * scale);
      CHECK(std::abs(torque[k]) < 1e-12 * scale);
      CHECK(std::abs(torque_before[k]) > 0.1);
    }
    CHECK(size > 1);
    CHECK(std::abs(along) < 1e-12 * size);
  }

  TEST_CASE("tensors: the cross product of tensors gives the cofactor, its rate and the trace") {
    const M3 F{{{1.1, 0.2, -0.3}, {0.1, 0.8, 0.25}, {-0.2, 0.05, 1.3}}};
    const M3 G{{{0.3, -0.2, 0.1}, {0.5, 0.1, -0.4}, {0.2, 0.6, -0.7}}};
    const M3 one{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const M3 twice = tensor_cross(F, F), with_one = tensor_cross(F, one), rate = tensor_cross(F, G);
    constexpr double step = 1e-6;
    M3 ahead = F, behind = F;
    ahead += step * G, behind += -step * G;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        CHECK(std::abs(twice(a, b) - 2 * cofactor(F)(a, b)) < 1e-15);
        CHECK(std::abs(with_one(a, b) - (trace(F) * one(a, b) - F(b, a))) < 1e-15);
        CHECK(std::abs(rate(a, b) - (cofactor(ahead)(a, b) - cofactor(behind)(a, b)) / (2 * step)) < 1e-9);
      }
    }
  }
}

TEST_SUITE("stability") {
  TEST_CASE("mixed: in 3D the step follows the waves of the strained body") {
    const auto step_of = [](double lambda) {
      return state_after(1, pressed_block(lambda), with_method("pf-jst")).time;
    };
    const Scene scene = pressed_block(1);
    const Material& rubber = scene.materials[0];
    const double stiffness = rubber.bulk_modulus() + 4.0 / 3 * rubber.shear_modulus();
    CHECK(step_of(1) == relative(0.25 * 0.87 * scene.spacing * std::sqrt(rubber.density / stiffness), 1e-9));
    // ρ0 c² along x is ∂²W/∂λ²
    const auto energy = [&](double l) {
      const double J = l, FF = l * l + 2;
      return rubber.shear_modulus() / 2 * (std::pow(J, -2.0 / 3) * FF - 3) +
             rubber.bulk_modulus() / 2 * (J - 1) * (J - 1);
    };
    constexpr double lambda = 0.4, d = 1e-4;
    const double along = (energy(lambda + d) - 2 * energy(lambda) + energy(lambda - d)) / (d * d);
    const double expected = step_of(1) * std::sqrt(stiffness / along);
    CHECK(expected < 0.75 * step_of(1));
    CHECK(step_of(lambda) == relative(expected, 1e-5));  // waves along x are the fastest
  }
}

TEST_SUITE("stability") {
  TEST_CASE(
      "mixed: a body softened by strain has the step of the unstrained body, also with an odd number of particles") {
    for (const double side : {4, 5}) {
      CAPTURE(side);
      Scene scene = pressed_block(1);
      const double dp = scene.spacing;
      const Material& rubber = scene.materials[0];
      scene.bodies[0].shapes = {Box{{0, 0, 0}, {side * dp, side * dp, side * dp}}};
      scene.bodies[0].on_boundary = true;
      for (std::size_t k = 0; k < 3; ++k)
        scene.bodies[0].displacement[k] = [=](const Point& x) { return -0.31 * x[k]; };
      Settings settings = with_method("pf");
      settings.law = "st-venant-kirchhoff";
      const double stiffness = rubber.bulk_modulus() + 4.0 / 3 * rubber.shear_modulus();
      CHECK(state_after(1, scene, settings).time ==
            relative(0.25 * 0.87 * dp * std::sqrt(rubber.density / stiffness), 1e-9));
    }
  }

  TEST_CASE("pf-jst: the energy of cell-centred 3D plates of two and three layers decreases") {
    for (const double layers : {2, 3}) {
      CAPTURE(layers);
      Scene scene = pressed_block(1);
      const double dp = scene.spacing, c0 = scene.materials[0].sound_speed();
      scene.bodies[0].shapes = {Box{{0, 0, 0}, {12 * dp, 12 * dp, layers * dp}}};
      for (int k = 0; k < 3; ++k)
        scene.bodies[0].velocity[k] = [=](const Point& x) { return 1e-4 * c0 * shake(x, (5 + k) * dp); };
      const Balance before = balance(state_after(0, scene, with_method("pf-jst")), scene);
      const Balance after = balance(state_after(300, scene, with_method("pf-jst")), scene);
      CHECK(after.kinetic + after.strain < before.kinetic);
    }
  }
}

TEST_SUITE("convergence") {
  TEST_CASE(
      "mixed: an independent H changes the motion of neo-Hookean bodies only by second order in the step") {
    const Scene scene = sprung_block();
    const auto difference = [&](double step) {
      Settings settings = with_method("pfj-jst");
      settings.step = step;
      const long steps = std::lround(6e-5 / step);
      const Snapshot a = state_after(steps, scene, settings);
      settings.method = "pfhj-jst";
      const Snapshot b = state_after(steps, scene, settings);
      double greatest = 0;
      for (std::size_t k = 0; k < a.x.size(); ++k) greatest = std::max(greatest, std::abs(a.x[k] - b.x[k]));
      return greatest;
    };
    const double coarse = difference(2e-6), fine = difference(1e-6);
    CHECK(coarse > 1e-12);
    CHECK(coarse < 1e-3 * scene.spacing);
    CHECK(coarse / fine == relative(4, 0.15));
  }
  TEST_CASE("mixed: in 2D pfj-jst and pfhj-jst give the same positions and pressures") {
    const Snapshot a = state_after(60, small_collision(), with_method("pfj-jst"));
    const Snapshot b = state_after(60, small_collision(), with_method("pfhj-jst"));
    CHECK(a.x == b.x);
    CHECK(a.p == b.p);
  }
}

}  // namespace of_this_file
