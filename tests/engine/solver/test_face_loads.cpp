
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/error.hpp"
#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/bonded/methods.hpp"
#include "engine/scene/shapes/combined.hpp"
#include "engine/scene/shapes/turned.hpp"
#include "engine/solver/face_loads.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double H = 0.02, E = 2e6, nu = 0.3, rho = 1000;

/// Damped, under a slowly increasing traction σ(y) at both ends.
Scene pulled_block(int across, double L, const std::function<double(double)>& sigma, double omega) {
  Scene scene;
  scene.name = "block";
  scene.spacing = H / across;
  scene.until = 50 / omega;
  scene.materials = {{"elastic", rho, E, nu}};
  scene.damping = 1.4 * omega;
  Body body;
  body.name = "block";
  body.shapes = {Box{{-L / 2, -H / 2, 0}, {L / 2, H / 2, 0}}};
  for (const double side : {-1.0, 1.0}) {
    Load load;
    load.kind = Load::Kind::traction;
    load.where = [=, dp = scene.spacing](const Point& X) { return side * X[0] > L / 2 - dp ? 1.0 : 0.0; };
    load.value[0] = [=](const Point& X) { return side * sigma(X[1]); };
    load.ramp = [=](double t) { return std::min(1.0, omega * t / 6); };
    body.loads.push_back(load);
  }
  scene.bodies = {body};
  return scene;
}

Snapshot at_rest(const Scene& scene, const char* method,
                 const std::map<std::string, double>& constants = {}) {
  Settings settings = with_method(method);
  settings.constants.insert(constants.begin(), constants.end());
  const auto simulation = make_simulation(scene, settings);
  simulation->advance_to(scene.until);
  return simulation->snapshot();
}

/// RMS of σxx − σ(y) over the RMS of σ(y), for |x| < `middle`.
double error(const Snapshot& now, const std::function<double(double)>& sigma, double middle) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Point X = now.initial(i);
    if (std::abs(X[0]) > middle) continue;
    difference += std::pow(now.stress(i).xx - sigma(X[1]), 2);
    size += std::pow(sigma(X[1]), 2);
  }
  return std::sqrt(difference / size);
}

/// Traction t on the upper face; with `both`, −t on the lower.
Scene thin_bar(int rows, const Point& t, bool both) {
  Scene scene;
  scene.name = "bar";
  scene.spacing = 0.001;
  scene.until = 1;
  scene.materials = {{"elastic", rho, E, nu}};
  Body body;
  body.name = "bar";
  const double top = rows * scene.spacing;
  body.shapes = {Box{{0, 0, 0}, {0.03, top, 0}}};
  for (const bool upper : {true, false}) {
    if (!upper && !both) continue;
    Load load;
    load.kind = Load::Kind::traction;
    load.where = [=](const Point& X) { return (upper ? X[1] > top - 0.001 : X[1] < 0.001) ? 1.0 : 0.0; };
    for (int k = 0; k < 2; ++k) load.value[k] = constant(upper ? t[k] : -t[k]);
    body.loads.push_back(load);
  }
  scene.bodies = {body};
  return scene;
}

Scene disc_or_ring(const Shape& shape) {
  Scene scene;
  scene.name = "round";
  scene.spacing = 0.001;
  scene.until = 1;
  scene.materials = {ring_rubber()};
  Body body;
  body.name = "round";
  body.shapes = {shape};
  scene.bodies = {body};
  return scene;
}

std::array<double, 3> sums(const std::vector<FaceShare>& shares, const InitialParticles& initial) {
  std::array<double, 3> sum{};
  for (const auto& [i, f] : shares) {
    sum[0] += f[0], sum[1] += f[1];
    sum[2] += initial.x[i][0] * f[1] - initial.x[i][1] * f[0];
  }
  return sum;
}

std::vector<FaceShare> shares_of(FaceRule rule, const Scene& scene, const Load& load) {
  const InitialParticles initial = make_initial_particles(scene);
  const double dp = scene.spacing, h = oenog.h_over_dp * dp;
  std::vector<int> id;
  for (int i = 0; i < initial.size(); ++i)
    if (load.where(initial.x[i]) != 0) id.push_back(i);
  const FaceLayer layer = face_layer(load, scene.bodies[0], initial, id, dp);
  REQUIRE(layer.id.size() == id.size());
  return face_shares(rule, layer, initial, greatest_bond_reach * h, surface(make_bonds(scene, initial, h)),
                     dp);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE(
      "face loads: by_column has the moment of a linear traction within 0.2 %, uniform is exact for uniform traction") {
    const Scene scene = pulled_block(
        10, 0.03, [](double y) { return 3 + 200 * y; }, 1);
    const InitialParticles initial = make_initial_particles(scene);
    Load load = scene.bodies[0].loads[1];
    const auto by_column = sums(shares_of(FaceRule::by_column, scene, load), initial);
    CHECK(by_column[0] == relative(3 * H));
    CHECK(by_column[1] == 0);
    CHECK(by_column[2] == relative(-200 * H * H * H / 12 * (1 - 0.0015)));
    load.value[0] = constant(3);
    load.value[1] = constant(2);
    const auto uniform = sums(shares_of(FaceRule::uniform, scene, load), initial);
    CHECK(uniform[0] == relative(3 * H));
    CHECK(uniform[1] == relative(2 * H));
    CHECK(uniform[2] == relative(0.015 * 2 * H));
  }

  TEST_CASE("face loads: on a circle force and torque equal the integrals over the face") {
    const Scene scene = disc_or_ring(Ring{{0, 0, 0}, 0.03, 0.04});
    Load load;
    load.kind = Load::Kind::traction;
    load.where = [](const Point& X) { return std::hypot(X[0], X[1]) > 0.039 ? 1.0 : 0.0; };
    load.value[0] = [](const Point& X) { return -X[1] / 0.04; };
    load.value[1] = [](const Point& X) { return X[0] / 0.04; };
    const auto sum = sums(shares_of(FaceRule::by_column, scene, load), make_initial_particles(scene));
    const double torque = 2 * std::numbers::pi * 0.04 * 0.04;
    CHECK(std::abs(sum[0]) < 1e-9 * torque);
    CHECK(sum[2] == relative(torque, 1e-3));
  }

  TEST_CASE(
      "face loads: on round layers that are not one spacing thick, the force equals the integral over the face") {
    using enum RoundLayout;
    struct Round {
      Shape shape;
      double radius;  // spacings
      bool thin = false;
    };
    const Point at{};
    for (const auto& [shape, radius, thin] :
         {Round{Disc{at, 0.005, spaced}, 5}, Round{Disc{at, 0.01, spaced}, 10},
          Round{Ring{at, 0.01, 0.01245, aligned}, 12.45, true},
          Round{Ring{at, 0.01, 0.01245, spaced}, 12.45, true}, Round{Ring{at, 0.01, 0.01545, aligned}, 15.45},
          Round{Ring{at, 0.01, 0.01545, spaced}, 15.45}}) {
      CAPTURE(radius);
      const double R = 0.001 * radius, P = 1e6;
      Scene scene = disc_or_ring(shape);
      Load load;
      load.kind = Load::Kind::traction;
      load.where = [=](const Point& X) { return std::hypot(X[0], X[1]) > R - 0.001 ? 1.0 : 0.0; };
      load.value[0] = [=](const Point& X) { return P * std::hypot(X[0], X[1]); };
      const double force = 2 * std::numbers::pi * R * P * R;
      const auto sum = sums(shares_of(FaceRule::by_column, scene, load), make_initial_particles(scene));
      CHECK(sum[0] == relative(force));
      scene.bodies[0].loads = {load};
      for (const char* method : {"oenog", "tl"}) {
        CAPTURE(method);
        if (method == std::string("tl") && !thin)
          continue;  // else the sum of S is not the area of a curved face
        const Snapshot now = state_after(1, scene, with_method(method));
        CHECK(balance(now, scene).linear_momentum[0] == relative(force * now.time, 1e-6));
      }
    }
  }

  TEST_CASE("face loads: a thin bar gets force and moment of the loaded face only") {
    const double A = 0.03, t = 2;
    for (int rows = 2; rows <= 10; ++rows) {
      CAPTURE(rows);
      const Scene scene = thin_bar(rows, {0.5 * t, t, 0}, false);
      const InitialParticles initial = make_initial_particles(scene);
      for (const FaceRule rule : {FaceRule::uniform, FaceRule::by_column}) {
        const auto shares = shares_of(rule, scene, scene.bodies[0].loads[0]);
        const auto sum = sums(shares, initial);
        CHECK(sum[0] == relative(0.5 * t * A));
        CHECK(sum[1] == relative(t * A));
        // by_column is exact in force only
        CHECK(sum[2] == relative(t * A * (0.5 * A - 0.5 * rows * scene.spacing),
                                 rule == FaceRule::uniform ? 1e-9 : 2e-5));
        for (const auto& [i, f] : shares)
          if (rows > 3 && initial.x[i][1] < scene.spacing) REQUIRE(f[1] == 0);
      }
    }
  }

  TEST_CASE("face loads: without area vectors the force of a column acts on the outermost particle") {
    const Scene scene = thin_bar(12, {0, 1, 0}, false);
    const InitialParticles initial = make_initial_particles(scene);
    const Load& load = scene.bodies[0].loads[0];
    std::vector<int> id;
    for (int i = 0; i < initial.size(); ++i)
      if (load.where(initial.x[i]) != 0) id.push_back(i);
    const FaceLayer layer = face_layer(load, scene.bodies[0], initial, id, scene.spacing);
    const std::vector<Point> none(initial.size());
    const auto shares =
        face_shares(FaceRule::by_column, layer, initial, 2.4 * scene.spacing, none, scene.spacing);
    CHECK(shares.size() == id.size());
    for (const auto& [i, f] : shares) {
      CHECK(load.where(initial.x[i]) != 0);
      const double from_corner = std::min(initial.x[i][0], 0.03 - initial.x[i][0]) / scene.spacing;
      const double more = from_corner < 1 ? 1.25 : from_corner < 2 ? -1.5 : from_corner < 3 ? 0.25 : 0;
      CHECK(f[1] == relative(scene.spacing * (1 + more / 24)));
    }
  }

  TEST_CASE("face loads: a uniform stress across a thin bar leaves no force on any particle") {
    for (int rows = 2; rows <= 10; ++rows) {
      CAPTURE(rows);
      const Scene scene = thin_bar(rows, {0, 1, 0}, true);
      const InitialParticles initial = make_initial_particles(scene);
      const auto S = surface(make_bonds(scene, initial, oenog.h_over_dp * scene.spacing));
      std::vector<double> left;
      for (const Point& one : S) left.push_back(one[1]);
      for (const Load& load : scene.bodies[0].loads)
        for (const auto& [i, f] : shares_of(FaceRule::uniform, scene, load)) left[i] -= f[1];
      for (const double f : left) REQUIRE(std::abs(f) < 1e-12 * scene.spacing);
    }
  }

  TEST_CASE("face loads: a thin bar of tl or oenog moves as its tractions on one or both faces require") {
    const double t = 1e-5 * E;
    for (const char* method : {"tl", "oenog"})
      for (int rows = 2; rows <= 10; ++rows) {
        CAPTURE(std::string(method));
        CAPTURE(rows);
        for (const bool both : {false, true}) {
          const Scene scene = thin_bar(rows, {0, t, 0}, both);
          const Snapshot now = state_after(40, scene, with_method(method));
          const double impulse = balance(now, scene).linear_momentum[1] / (t * 0.03 * now.time);
          CHECK(impulse == Approx(both ? 0 : 1).scale(1).epsilon(1e-6));
        }
      }
  }

  TEST_CASE("face loads: a region that is not one layer along one side has no face") {
    const Scene scene = pulled_block(
        10, 0.03, [](double) { return 1.0; }, 1);
    const InitialParticles initial = make_initial_particles(scene);
    std::vector<int> deep, corner;
    for (int i = 0; i < initial.size(); ++i) {
      if (initial.x[i][0] > 0.009) deep.push_back(i);
      if (initial.x[i][0] > 0.013 || initial.x[i][1] > 0.008) corner.push_back(i);
    }
    const Load& load = scene.bodies[0].loads[1];
    for (const std::vector<int>& id : {deep, corner, {deep[0]}})
      CHECK(face_layer(load, scene.bodies[0], initial, id, scene.spacing).id.empty());
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("patch test: under a uniform traction tl, pf-jst and pfj-jst have a uniform stress") {
    const double omega = 1.57 * std::sqrt(E / rho) / H;
    const auto sigma = [](double) { return 2e-5 * E; };
    for (const char* method : {"tl", "pf-jst", "pfj-jst"}) {
      CAPTURE(std::string(method));
      const Snapshot now = at_rest(pulled_block(6, 1.5 * H, sigma, omega), method);
      for (std::size_t i = 0; i < now.size(); ++i) {
        REQUIRE(now.stress(i).xx == Approx(sigma(0)).epsilon(5e-4));
        REQUIRE(std::abs(now.stress(i).yy) < 5e-4 * sigma(0));
        REQUIRE(std::abs(now.stress(i).xy) < 5e-4 * sigma(0));
      }
    }
    // oenog is not exact at corners
    CHECK(error(at_rest(pulled_block(6, 1.5 * H, sigma, omega), "oenog"), sigma, 1) < 0.05);
  }

  TEST_CASE(
      "bent block at rest: the stress across the block converges to the exact one, also in surface rows") {
    const double L = 3 * H, omega = 22.4 * H / (L * L) * std::sqrt(E / ((1 - nu * nu) * 12 * rho));
    const auto sigma = [](double y) { return 20 * y / (H / 2); };
    const auto across = [&](const char* method, int rows,
                            const std::map<std::string, double>& constants = {}) {
      return error(at_rest(pulled_block(rows, L, sigma, omega), method, constants), sigma, L / 6);
    };
    const double oenog_coarse = across("oenog", 5), oenog_fine = across("oenog", 10);
    CHECK(oenog_fine < 0.006);
    CHECK(oenog_fine < 0.4 * oenog_coarse);
    const Snapshot bent = at_rest(pulled_block(10, L, sigma, omega), "oenog", {});
    for (std::size_t i = 0; i < bent.size(); ++i)
      if (const Point X = bent.initial(i); std::abs(X[0]) < L / 6 && std::abs(X[1]) < 0.3 * H)
        CHECK(bent.stress(i).xx == relative(sigma(X[1]), 1e-3));
    const double tl_coarse = across("tl", 5), tl_fine = across("tl", 10);
    CHECK(tl_coarse < 0.01);
    CHECK(tl_fine < 0.7 * tl_coarse);
    CHECK(across("tl", 20) < 0.5 * tl_fine);
    CHECK(across("pf-jst", 10) < 0.006);
    CHECK(across("pfj-jst", 10) < 0.006);
    CHECK(across("tl", 10, {{"h", 1.05}}) > 0.02);
  }
}

TEST_SUITE("unit") {
  TEST_CASE(
      "traction: methods with initial neighbours refuse a region of two adjacent sides, not of opposite sides") {
    const auto loaded = [](int dim, const Expression& where, const char* method) {
      Scene scene = thin_bar(6, {100, 0, 0}, false);
      scene.dim = dim;
      if (dim == 3) scene.bodies[0].shapes = {Box{{0, 0, 0}, {0.03, 0.006, 0.006}}};
      scene.bodies[0].loads[0].where = where;
      try {
        make_simulation(scene, with_method(method));
        return true;
      } catch (const SceneError& error) {
        CHECK(error.key == "body.bar.loaded");
        CHECK(std::string(error.what()).find("on two faces that meet at an edge") != std::string::npos);
        return false;
      }
    };
    const auto top = [](const Point& X) { return X[1] > 0.005 ? 1.0 : 0.0; };
    const auto bottom = [](const Point& X) { return X[1] < 0.001 ? 1.0 : 0.0; };
    const auto end = [](const Point& X) { return X[0] > 0.029 ? 1.0 : 0.0; };
    for (const int dim : {2, 3})
      for (const char* method : {"tl", "pf-jst", "oenog"}) {
        CAPTURE(dim);
        CAPTURE(method);
        CHECK(loaded(dim, top, method));
        CHECK(loaded(dim, end, method));
        CHECK(loaded(
            dim, [&](const Point& X) { return top(X) + bottom(X); }, method));
        CHECK_FALSE(loaded(
            dim, [&](const Point& X) { return top(X) + end(X); }, method));
      }
    CHECK(loaded(
        2, [&](const Point& X) { return top(X) + end(X); }, "enog"));
  }

  TEST_CASE("traction: two adjacent sides are refused also for a rotated box and a union of boxes") {
    const Rotation turn{.about = {0.1, 0, 0}, .angle = 30};
    const auto refused = [](const std::vector<Shape>& shapes, const std::optional<Rotation>& back) {
      Scene scene = thin_bar(6, {100, 0, 0}, false);
      scene.bodies[0].shapes = shapes;
      scene.bodies[0].loads[0].where = [=](const Point& x) {
        const Point X = back ? rotated(*back, x) : x;
        return X[1] > 0.005 || X[0] > 0.029 ? 1.0 : 0.0;
      };
      try {
        make_simulation(scene, with_method("tl"));
        return false;
      } catch (const SceneError& error) {
        return std::string(error.what()).find("on two faces that meet at an edge") != std::string::npos;
      }
    };
    const Box box{{0, 0, 0}, {0.03, 0.006, 0}}, half{{0, 0, 0}, {0.015, 0.006, 0}};
    const Combined both{Combination::together, {box, half}};
    const Rotation back{.about = turn.about, .angle = -turn.angle};
    CHECK(refused({Turned{box, turn}}, back));
    CHECK(refused({Turned{both, turn}}, back));
    CHECK(refused({Turned{box, turn}, Turned{half, turn}}, back));
    CHECK(refused({box, Turned{half, Rotation{.about = {0.0075, 0.003, 0}, .angle = 180}}}, {}));
    // steps of the lattice on the rotated box are no edges
    CHECK_FALSE(refused({half, Turned{box, turn}}, back));
    CHECK_FALSE(refused({Turned{Disc{{0.015, 0, 0}, 0.02}, turn}}, back));
  }
}

}  // namespace of_this_file
