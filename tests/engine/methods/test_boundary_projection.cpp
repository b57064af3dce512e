#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/methods/tl_mixed/boundary_projection.hpp"
#include "engine/methods/tl_mixed/methods.hpp"
#include "tests/engine/dense.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// Weights V W, [Lee2016] Eq. 23.
std::vector<std::pair<int, double>> corrected_weights(int i, const std::vector<Point>& X,
                                                      const std::vector<double>& V, double h, int dim) {
  std::vector<std::pair<int, double>> W;
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(1 + dim, 1 + dim);
  const auto basis = [&](int a) {
    Eigen::VectorXd b(1 + dim);
    b[0] = 1;
    for (int k = 0; k < dim; ++k) b[1 + k] = X[i][k] - X[a][k];
    return b;
  };
  for (int a = 0; a < static_cast<int>(X.size()); ++a) {
    const double q = distance(X[i], X[a]) / h;
    if (q >= 2 * (1 - 1e-9)) continue;
    W.emplace_back(a, std::pow(1 - 0.5 * q, 4) * (1 + 2 * q));
    M += V[a] * W.back().second * basis(a) * basis(a).transpose();
  }
  const Eigen::VectorXd c = solution(M, Eigen::VectorXd::Unit(1 + dim, 0));
  for (auto& [a, value] : W) value *= V[a] * c.dot(basis(a));
  return W;
}

double h_over_dp(int dim) { return dim == 3 ? pf.h_over_dp_3d : pf.h_over_dp; }

/// Particles, clamped at x = 0, with rollers at y = 0; dp = 1.
struct Made {
  Made(int dim, double jitter) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int i = 0; i < 7; ++i) {
      for (int j = 0; j < 6; ++j) {
        for (int k = 0; k < (dim == 3 ? 5 : 1); ++k) {
          X.push_back(
              {i + jitter * any(random), j + jitter * any(random), dim == 3 ? k + jitter * any(random) : 0});
          V.push_back((i == 0 ? 0.5 : 1) * (j == 0 ? 0.5 : 1));
          m.push_back(V.back() * (1 + 0.2 * any(random)));
          axes.push_back(i == 0 ? (1u << dim) - 1 : j == 0 ? 2 : 0);
          v.push_back({any(random), any(random), dim == 3 ? any(random) : 0});
        }
      }
    }
    for (int i = 0; i < static_cast<int>(X.size()); ++i)
      if (axes[i] != 0)
        points.push_back({corrected_weights(i, X, V, h_over_dp(dim), dim),
                          axes[i],
                          {any(random), any(random), dim == 3 ? any(random) : 0}});
  }
  std::vector<Point> X, v;
  std::vector<double> V, m;
  std::vector<unsigned> axes;
  std::vector<BoundaryPoint> points;
};

double kinetic_energy(const Made& made, const std::vector<Point>& v) {
  double sum = 0;
  for (std::size_t a = 0; a < v.size(); ++a)
    for (const double v_k : v[a]) sum += 0.5 * made.m[a] * v_k * v_k;
  return sum;
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point interpolated(const BoundaryPoint& point, const std::vector<Point>& f) {
  Point sum{};
  for (const auto& [a, w] : point.w)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += w * f[a][k];
  return sum;
}

Scene clamped_and_driven(int dim) {
  const double dp = 0.001;
  Scene scene;
  scene.name = "held-and-driven";
  scene.dim = dim;
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  Body body;
  body.name = "block";
  body.shapes = {Box{{0, 0, 0}, {8 * dp, 5 * dp, dim == 3 ? 4 * dp : 0}}};
  body.clamped = [=](const Point& x) { return x[0] < dp ? 1.0 : 0.0; };
  body.guided[1] = [=](const Point& x) { return x[1] < dp ? 1.0 : 0.0; };
  Drive drive;
  drive.where = [=](const Point& x) { return x[0] > 7 * dp ? 1.0 : 0.0; };
  drive.velocity[0] = [](double t) { return 2 * std::cos(1e5 * t); };
  drive.until = 1;
  body.drives = {drive};
  body.velocity[1] = [=](const Point& x) { return 3 * shake(x, 5 * dp); };
  scene.bodies = {body};
  return scene;
}

Settings projected(const std::string& method, double on = 1, double h = 0) {
  Settings settings = with_method(method);
  settings.constants["boundary_projection"] = on;
  if (h > 0) settings.constants["h"] = h;
  return settings;
}

/// Greatest |v(X_B) − v_B|.
double greatest_miss(const Scene& scene, const Snapshot& now, double h) {
  std::vector<Point> X;
  std::vector<double> V;
  for (std::size_t i = 0; i < now.size(); ++i) {
    X.push_back(now.initial(i));
    V.push_back(now.m[i] / scene.materials[0].density);
  }
  const Body& body = scene.bodies[0];
  double greatest = 0;
  for (int i = 0; i < static_cast<int>(X.size()); ++i) {
    const bool driven = body.drives[0].where(X[i]) != 0, clamped = body.clamped(X[i]) != 0;
    Point sum{};
    for (const auto& [a, W] : corrected_weights(i, X, V, h * scene.spacing, scene.dim))
      for (std::size_t k = 0; k < 3; ++k) sum[k] += W * now.velocity(a)[k];
    const Point given{driven ? body.drives[0].velocity[0](now.time) : 0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k)
      if (driven || clamped || (k == 1 && body.guided[1](X[i]) != 0))
        greatest = std::max(greatest, std::abs(sum[k] - given[k]));
  }
  return greatest;
}

}  // namespace

TEST_SUITE("term") {
  TEST_CASE("boundary projection: boundary points get prescribed velocities by impulses at them") {
    for (const int dim : {2, 3}) {
      for (const double jitter : {0.0, 0.15}) {
        CAPTURE(dim);
        CAPTURE(jitter);
        const Made made(dim, jitter);
        const BoundaryProjection projection(made.points, made.m);
        std::vector<Point> v = made.v;
        const std::vector<Point> impulses = projection(v);
        Point momentum{}, turn{};  // less those that the boundary adds
        for (std::size_t B = 0; B < made.points.size(); ++B) {
          const BoundaryPoint& point = made.points[B];
          const Point there = interpolated(point, v), before = interpolated(point, made.v),
                      moment = cross(interpolated(point, made.X), impulses[B]);
          for (std::size_t k = 0; k < 3; ++k) {
            if (point.axes >> k & 1) CHECK(std::abs(there[k] - point.velocity[k]) < 1e-12);
            momentum[k] -= impulses[B][k], turn[k] -= moment[k];
          }
          CHECK(std::abs(before[1] - point.velocity[1]) > 1e-6);
        }
        for (std::size_t a = 0; a < v.size(); ++a) {
          const Point change{v[a][0] - made.v[a][0], v[a][1] - made.v[a][1], v[a][2] - made.v[a][2]},
              moment = cross(made.X[a], change);
          for (std::size_t k = 0; k < 3; ++k)
            momentum[k] += made.m[a] * change[k], turn[k] += made.m[a] * moment[k];
        }
        for (std::size_t k = 0; k < 3; ++k) {
          CHECK(std::abs(momentum[k]) < 1e-11);
          CHECK(std::abs(turn[k]) < 1e-10);
        }
        std::vector<Point> again = v;
        for (const Point& impulse : projection(again))
          for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(impulse[k]) < 1e-11);
      }
    }
  }

  TEST_CASE(
      "boundary projection: a boundary at rest takes the kinetic energy of the change, and never adds any") {
    for (const int dim : {2, 3}) {
      Made made(dim, 0.15);
      for (BoundaryPoint& point : made.points) point.velocity = {};
      std::vector<Point> v = made.v, change = made.v;
      BoundaryProjection(made.points, made.m)(v);
      for (std::size_t a = 0; a < v.size(); ++a)
        for (std::size_t k = 0; k < 3; ++k) change[a][k] -= v[a][k];
      CHECK(kinetic_energy(made, change) > 0.01 * kinetic_energy(made, v));
      CHECK(kinetic_energy(made, made.v) ==
            Approx(kinetic_energy(made, v) + kinetic_energy(made, change)).epsilon(1e-12));
    }
  }

  TEST_CASE("boundary projection: a linear field that fulfils the conditions is unchanged") {
    Made made(3, 0.15);
    const auto linear = [](const Point& x) {
      return Point{1 + 0.3 * x[0] - 0.2 * x[1], -2 + 0.1 * x[1] * 1 + 0.4 * x[2], 0.7 * x[0]};
    };
    for (std::size_t a = 0, B = 0; a < made.X.size(); ++a) {
      made.v[a] = linear(made.X[a]);
      if (made.axes[a] != 0) made.points[B++].velocity = linear(made.X[a]);
    }
    std::vector<Point> v = made.v;
    BoundaryProjection(made.points, made.m)(v);
    for (std::size_t a = 0; a < v.size(); ++a)
      for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(v[a][k] - made.v[a][k]) < 1e-11);
  }

  TEST_CASE("boundary projection: rollers leave free components unchanged") {
    Made made(2, 0.15);
    std::erase_if(made.points, [](const BoundaryPoint& point) { return point.axes != 2; });
    REQUIRE(made.points.size() == 6);
    std::vector<Point> v = made.v;
    BoundaryProjection(made.points, made.m)(v);
    for (std::size_t a = 0; a < v.size(); ++a) CHECK(v[a][0] == made.v[a][0]);
    CHECK(v[6][1] != made.v[6][1]);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE(
      "boundary projection: after five steps interpolated velocities fulfil clamps, rollers and drives") {
    struct Row {
      int dim;
      double h, without;  // least miss without projection
    };
    for (const auto& [dim, h, without] :
         {Row{2, h_over_dp(2), 1e-4}, Row{2, 1.05, 1e-3}, Row{3, h_over_dp(3), 1e-3}}) {
      const Scene scene = clamped_and_driven(dim);
      for (const std::string method : {"pf", "pf-jst", "pfj-jst", "pfhj-jst"}) {
        const auto miss = [&, h = h](double on) {
          return greatest_miss(scene, state_after(5, scene, projected(method, on, h)), h);
        };
        CAPTURE(scene.dim);
        CAPTURE(method);
        CHECK(miss(1) < 1e-11);
        CHECK(miss(0) > without);
        const Snapshot now = state_after(5, scene, projected(method, 1, h));
        for (std::size_t i = 0; i < now.size(); ++i)
          if (now.clamped[i] != 0) CHECK(now.position(i) == now.initial(i));
      }
    }
  }

  TEST_CASE("boundary projection: a free body is unchanged") {
    Scene scene = clamped_and_driven(2);
    const auto same = [&] {
      const Snapshot on = state_after(20, scene, projected("pf-jst")),
                     off = state_after(20, scene, projected("pf-jst", 0));
      return on.x == off.x && on.v == off.v;
    };
    CHECK_FALSE(same());
    scene.bodies[0].clamped = {};
    scene.bodies[0].guided = {};
    scene.bodies[0].drives.clear();
    CHECK(same());
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("boundary projection: reactions account for momentum and the work of drives for energy") {
    for (const int dim : {2, 3}) {
      Scene scene = clamped_and_driven(dim);
      for (const int axis : {0, 1}) {
        scene.probes.push_back(make_probe("", Probe::Kind::reaction, {0}));
        scene.probes.back().axis = axis;
      }
      scene.gravity[1] = [](double) { return -1e5; };
      const auto excess = [&](double step) {  // of energy over start and work, after 4e-5 s
        Settings settings = projected("pf");
        settings.step = step;
        const auto simulation = make_simulation(scene, settings);
        make_steps(*simulation, 1);  // brings the start into agreement with the clamp
        Balance last = balance(simulation->snapshot(), scene);
        const double start = last.kinetic + last.strain - last.work;
        double mass = 0;
        for (const double m : simulation->snapshot().m) mass += m;
        while (simulation->snapshot().time < 4e-5) {
          make_steps(*simulation, 1);
          const Balance now = balance(simulation->snapshot(), scene);
          for (const std::size_t k : {0, 1}) {
            const double force =
                (now.linear_momentum[k] - last.linear_momentum[k]) / step + (k == 1 ? 1e5 * mass : 0);
            CHECK(simulation->series().value[k].back() ==
                  Approx(force).scale(now.momentum_scale / step).epsilon(1e-9));
          }
          last = now;
        }
        return std::abs(last.kinetic + last.strain - last.work - start) / (last.kinetic + last.strain);
      };
      CAPTURE(dim);
      const double coarse = excess(2e-7), fine = excess(1e-7);
      CHECK(coarse < 1e-3);
      CHECK(fine < 0.3 * coarse);
    }
  }
}

TEST_SUITE("determinism") {
  TEST_CASE(
      "boundary projection: two threads and a checkpoint after a drive's end give the same positions and velocities") {
    Scene scene = clamped_and_driven(2);
    Settings settings = projected("pfj-jst");
    settings.step = 2e-6;
    scene.bodies[0].drives[0].until = 2.5e-5;
    const Snapshot once = state_after(30, scene, settings);
    settings.threads = 2;
    const auto first = make_simulation(scene, settings), second = make_simulation(scene, settings);
    make_steps(*first, 20);
    second->load(first->save());
    make_steps(*second, 10);
    CHECK(second->snapshot().x == once.x);
    CHECK(second->snapshot().v == once.v);
  }
}

}  // namespace of_this_file
