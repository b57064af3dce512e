
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/bonded/methods.hpp"
#include "engine/scene/shapes/turned.hpp"
#include "engine/solver/face_loads.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double E = 2e6, nu = 0.3, rho = 1000;

Load traction(Expression where, const std::array<Expression, 3>& value) {
  Load load;
  load.kind = Load::Kind::traction;
  load.where = std::move(where);
  load.value = value;
  return load;
}

Scene scene_of(Shape shape, double dp, std::vector<Load> loads) {
  Scene scene;
  scene.name = "body";
  scene.dim = 3;
  scene.spacing = dp;
  scene.until = 1;
  scene.materials = {{"elastic", rho, E, nu}};
  Body body;
  body.name = "body";
  body.shapes = {std::move(shape)};
  body.loads = std::move(loads);
  scene.bodies = {body};
  return scene;
}

std::vector<FaceShare> shares_of(FaceRule rule, const Scene& scene, std::size_t load = 0) {
  const InitialParticles initial = make_initial_particles(scene);
  const double h = oenog.h_over_dp * scene.spacing;
  const Load& one = scene.bodies[0].loads[load];
  std::vector<int> id;
  for (int i = 0; i < initial.size(); ++i)
    if (one.where(initial.x[i]) != 0) id.push_back(i);
  const FaceLayer layer = face_layer(one, scene.bodies[0], initial, id, scene.spacing);
  REQUIRE(layer.id.size() == id.size());
  return face_shares(rule, layer, initial, greatest_bond_reach * h, surface(make_bonds(scene, initial, h)),
                     scene.spacing);
}

struct Sum {
  Point force{}, moment{};
};
Sum sum_of(const std::vector<FaceShare>& shares, const Scene& scene) {
  const InitialParticles initial = make_initial_particles(scene);
  Sum sum;
  for (const auto& [i, f] : shares)
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      sum.force[k] += f[k];
      sum.moment[k] += initial.x[i][a] * f[b] - initial.x[i][b] * f[a];
    }
  return sum;
}

constexpr double H = 0.02, dp = H / 6, half = 1.5 * H;
Snapshot drawn_out(const char* method, double sigma) {
  const double omega = 2000;  // near the lowest longitudinal mode
  std::vector<Load> ends;
  for (const double side : {-1.0, 1.0}) {
    ends.push_back(traction([=](const Point& X) { return side * X[0] > half - dp ? 1.0 : 0.0; },
                            {constant(side * sigma), constant(0), constant(0)}));
    ends.back().ramp = [=](double t) { return std::min(1.0, omega * t / 6); };
  }
  Scene scene = scene_of(Box{{-half, -H / 2, -H / 2}, {half, H / 2, H / 2}}, dp, ends);
  scene.damping = 1.4 * omega;
  const auto simulation = make_simulation(scene, with_method(method));
  simulation->advance_to(35 / omega);
  return simulation->snapshot();
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("face loads in 3D: force and moment equal the integrals over the face, with edges and corners") {
    const double A = 0.007, B = 0.006, L = 0.008;
    const auto block = [&](Expression along_x) {
      const Load load = traction([=](const Point& X) { return X[0] > L - 0.001 ? 1.0 : 0.0; },
                                 {std::move(along_x), constant(2), constant(-1)});
      return scene_of(Box{{0, -A / 2, -B / 2}, {L, A / 2, B / 2}}, 0.001, {load});
    };
    for (const FaceRule rule : {FaceRule::uniform, FaceRule::by_column}) {
      const Scene scene = block(constant(3));
      const Sum sum = sum_of(shares_of(rule, scene), scene);
      CHECK(sum.force[0] == relative(3 * A * B));
      CHECK(sum.force[1] == relative(2 * A * B));
      CHECK(sum.moment[2] == relative(2 * A * B * L));
      CHECK(sum.moment[1] == relative(1 * A * B * L));
    }
    const Scene scene = block([](const Point& X) { return 3 + 2e4 * X[1] + 1e4 * X[2]; });
    const Sum sum = sum_of(shares_of(FaceRule::by_column, scene), scene);
    CHECK(sum.force[0] == relative(3 * A * B));
    CHECK(sum.moment[2] == relative(2 * A * B * L - 2e4 * B * A * A * A / 12, 7e-3));
    CHECK(sum.moment[1] == relative(1 * A * B * L + 1e4 * A * B * B * B / 12, 7e-3));
  }

  TEST_CASE("face loads in 3D: a plate gets the force of the loaded face only") {
    for (int layers = 2; layers <= 8; ++layers) {
      CAPTURE(layers);
      const double top = 0.001 * layers;
      const Load load = traction([=](const Point& X) { return X[2] > top - 0.001 ? 1.0 : 0.0; },
                                 {constant(0), constant(0), constant(1)});
      const Scene scene = scene_of(Box{{0, 0, 0}, {0.009, 0.008, top}}, 0.001, {load});
      const InitialParticles initial = make_initial_particles(scene);
      const auto shares = shares_of(FaceRule::by_column, scene);
      const Sum sum = sum_of(shares, scene);
      CHECK(sum.force[2] == relative(0.009 * 0.008));
      CHECK(sum.moment[0] == relative(0.009 * 0.008 * 0.004, 1e-3));
      for (const auto& [i, f] : shares)
        if (layers > 3 && initial.x[i][2] < 0.001) REQUIRE(f[2] == 0);
    }
  }

  TEST_CASE("face loads in 3D: the pressure in a hollow ball acts on its inner face") {
    const double inner = 0.03;
    for (const double dp : {0.005, 0.004, 0.0057, 0.0045}) {
      CAPTURE(dp);
      const auto outwards = [](int k) -> Expression {
        return [k](const Point& X) { return X[k] / std::hypot(X[0], X[1], X[2]); };
      };
      const Load load =
          traction([=](const Point& X) { return std::hypot(X[0], X[1], X[2]) < inner + dp ? 1.0 : 0.0; },
                   {outwards(0), outwards(1), outwards(2)});
      const Scene scene = scene_of(Ring{{0, 0, 0}, inner, 0.05, RoundLayout::aligned}, dp, {load});
      const InitialParticles initial = make_initial_particles(scene);
      double force = 0;
      for (const auto& [i, f] : shares_of(FaceRule::by_column, scene))
        for (int k = 0; k < 3; ++k) force += f[k] * outwards(k)(initial.x[i]);
      // the area of the face, not of the layer
      CHECK(force == relative(4 * std::numbers::pi * inner * inner, 0.01));
    }
  }
}

TEST_SUITE("unit") {
  TEST_CASE(
      "face loads in 3D: on a rotated pipe, the force equals the integral over the outer or an end face") {
    const double dp = 0.002, inner = 0.018, outer = 0.0251, length = 0.0251;
    const Rotation turn{.axis = {1, 0, 0}, .about = {}, .angle = 40},
        back{.axis = turn.axis, .about = turn.about, .angle = -turn.angle};
    const auto radius = [=](const Point& x) {
      const Point X = rotated(back, x);
      return std::hypot(X[0], X[1]);
    };
    const auto along = [=](const Point& x) { return rotated(back, x)[2]; };
    const Cylinder pipe{{0, 0, 0}, {0, 0, length}, outer, inner, RoundLayout::aligned};
    const Load side = traction([=](const Point&x) { return radius(x) > outer - dp ? 1.0 : 0.0; },
                               {radius, constant(0), constant(0)}),
               end = traction([=](const Point&x) { return along(x) > length - dp ? 1.0 : 0.0; },
                              {along, constant(0), constant(0)});
    const Scene scene = scene_of(Turned{pipe, turn}, dp, {side, end});
    constexpr double pi = std::numbers::pi;
    CHECK(sum_of(shares_of(FaceRule::by_column, scene, 0), scene).force[0] ==
          relative(2 * pi * outer * length * outer, 0.01));
    CHECK(sum_of(shares_of(FaceRule::by_column, scene, 1), scene).force[0] ==
          relative(pi * (outer * outer - inner * inner) * length, 1e-3));
  }
}

TEST_SUITE("analytic") {
  TEST_CASE(
      "patch test in 3D: in tl, pf-jst and pfj-jst a bar under traction has a uniform stress up to its ends") {
    const double sigma = 0.01 * E;
    for (const char* method : {"tl", "pf-jst", "pfj-jst"}) {
      CAPTURE(std::string(method));
      const Snapshot now = drawn_out(method, sigma);
      const double xx = now.stress(0).xx;
      CHECK(xx == relative(sigma, 0.01));
      for (std::size_t i = 0; i < now.size(); ++i) {
        REQUIRE(now.stress(i).xx == relative(xx, 1e-3));
        REQUIRE(std::abs(now.stress(i).yy) < 1e-3 * xx);
        REQUIRE(std::abs(now.stress(i).xy) < 1e-3 * xx);
      }
    }
    // oenog is not exact at corners
    const auto length = [](const Snapshot& now) {
      double low = 0, high = 0;
      for (std::size_t i = 0; i < now.size(); ++i) {
        const Point X = now.initial(i);
        if (std::abs(X[1]) > dp || std::abs(X[2]) > dp) continue;
        low = std::min(low, now.position(i)[0]), high = std::max(high, now.position(i)[0]);
      }
      return high - low;
    };
    const double undrawn = 2 * half - dp;
    CHECK(length(drawn_out("oenog", sigma)) - undrawn ==
          relative(length(drawn_out("tl", sigma)) - undrawn, 3e-3));
  }
}

}  // namespace of_this_file
