
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/judge/verdict.hpp"
#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/bonded/methods.hpp"
#include "tests/engine/methods/bonded/cantilever_3d.hpp"
#include "tests/engine/methods/bonded/naive_oenog.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

using Naive = NaiveOenogIn<3>;
using Square = Eigen::Matrix3d;

constexpr double dp = 0.001;
constexpr double h_over_dp = 0.9;

Scene alone(const Shape& shape) {
  Scene scene = small_solid_collision();
  scene.bodies.pop_back();
  scene.bodies[0].shapes = {shape};
  scene.bodies[0].velocity = {};
  return scene;
}
Scene block(int x, int y, int z) { return alone(Box{{0, 0, 0}, {x * dp, y * dp, z * dp}}); }
Scene clamped_block(int x, int y, int z) {
  Scene scene = alone(Box{{-3 * dp, 0, 0}, {x * dp, y * dp, z * dp}});
  scene.bodies[0].clamped = [](const Point& X) { return X[0] < 0 ? 1.0 : 0.0; };
  return scene;
}
Scene block_on_faces(int x, int y, int z) {
  Scene scene = block(x, y, z);
  scene.bodies[0].on_boundary = true;
  scene.bodies[0].clamped = [](const Point& X) { return X[0] <= 0 ? 1.0 : 0.0; };
  return scene;
}
/// The tip has no neighbours along two axes.
Scene block_with_tip() {
  Scene scene = block(3, 3, 3);
  scene.bodies[0].shapes.push_back(Box{{dp, dp, 3 * dp}, {2 * dp, 2 * dp, 4 * dp}});
  return scene;
}
Scene cube_at_wall() {
  Scene scene = block(8, 8, 8);
  scene.bodies[0].velocity[0] = constant(-0.9 * scene.materials[0].sound_speed());
  Wall wall;
  wall.name = "wall";
  wall.at = {-0.0005, 0, 0};
  wall.normal = {1, 0, 0};
  scene.walls = {wall};
  return scene;
}
Scene ball() { return alone(Disc{{}, 0.0047}); }

Naive::Places deformed(const InitialParticles& initial, const Square& F) {
  Naive::Places at;
  for (const Point& X : initial.x) {
    const Eigen::Vector3d x = F * Eigen::Vector3d(X[0], X[1], X[2]);
    at.push_back({x[0], x[1], x[2]});
  }
  return at;
}

Square random_matrix(std::mt19937& random) {
  return Square::NullaryExpr(
      [&](Eigen::Index, Eigen::Index) { return 2 * std::generate_canonical<double, 53>(random) - 1; });
}
Square random_rotation(std::mt19937& random) {
  const Square M = random_matrix(random);
  return Eigen::Quaterniond(Eigen::Vector4d(M(0, 0), M(0, 1), M(0, 2), M(1, 1)).normalized())
      .toRotationMatrix();
}

/// Greatest force on selected particles, divided by G ε dp², for random homogeneous strains of size ε.
template <class Counts>
double unbalanced(const Scene& scene, const Counts& counts) {
  const double G = scene.materials[0].shear_modulus();
  const InitialParticles initial = make_initial_particles(scene);
  const Naive naive(scene, h_over_dp);
  std::mt19937 random(3);
  double greatest = 0;
  int counted = 0;
  for (const double size : {1e-3, 0.1}) {
    const auto force = naive.force(deformed(initial, Square::Identity() + size * random_matrix(random)));
    for (int i = 0; i < naive.size(); ++i) {
      if (!counts(initial.x[i])) continue;
      ++counted;
      for (const double f : force[i]) greatest = std::max(greatest, std::abs(f) / (G * size * dp * dp));
    }
  }
  CHECK(counted > 0);
  return greatest;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

Naive strained(const Scene& scene, int steps) {
  Naive naive(scene, h_over_dp);
  for (int k = 0; k < steps; ++k) naive.step(oenog.cfl, 0);
  return naive;
}

Scene shaken_block() {
  Scene scene = small_solid_collision();
  scene.bodies.pop_back();
  return scene;
}

Scene two_blocks() {
  const double c0 = ring_rubber().sound_speed();
  Scene scene = small_solid_collision();
  scene.name = "two-blocks";
  scene.bodies[1].shapes = {Box{{0.0004, -0.0009, -0.0017}, {0.0044, 0.0031, 0.0013}}};
  scene.bodies[1].velocity[2] = [=](const Point& x) { return c0 * (-0.02 + 0.02 * shake(x, 5 * dp)); };
  return scene;
}

bool same_bytes(const Snapshot& a, const Snapshot& b) {
  const auto same = [](const std::vector<double>& of_a, const std::vector<double>& of_b) {
    return of_a.size() == of_b.size() &&
           std::memcmp(of_a.data(), of_b.data(), of_a.size() * sizeof(double)) == 0;
  };
  return a.time == b.time && same(a.x, b.x) && same(a.v, b.v) && same(a.s, b.s) &&
         same(a.strain_energy, b.strain_energy);
}

Scene twisting_cantilever(int across) {
  Scene scene = square_cantilever(across);
  const auto rate = [](const Point& x) { return 5 * std::sin(std::numbers::pi * x[0] / 0.4); };
  scene.bodies[0].velocity[1] = [=](const Point& x) { return -rate(x) * x[2]; };
  scene.bodies[0].velocity[2] = [=](const Point& x) { return rate(x) * x[1]; };
  scene.probes[0].at[1] = 0.01 - scene.spacing / 2;
  scene.probes[0].axis = 2;
  return scene;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE(
      "bonds: in 3D an interior particle has 26 bonds with isotropic moments, and a six-point gradient") {
    const Scene scene = block(5, 5, 5);
    const Bonds bonds = make_bonds(scene, make_initial_particles(scene), h_over_dp * dp);
    const int middle = 62;
    REQUIRE(bonds.begin[middle + 1] - bonds.begin[middle] == 26);
    double moment[3][3] = {};
    double odd = 0;
    int of_axes = 0;
    std::map<double, int> weights;
    const auto known = [](double w) { return std::abs(w - 2.0 / 3) < 1e-10 ? 2.0 / 3 : w; };
    for (int b = bonds.begin[middle]; b < bonds.begin[middle + 1]; ++b) {
      const Eigen::Vector3d e = Eigen::Vector3d(bonds.of(middle, b).X.data()).normalized();
      for (int a = 0; a < 3; ++a)
        for (int k = 0; k < 3; ++k) moment[a][k] += bonds.of(middle, b).weight * e[a] * e[a] * e[k] * e[k];
      odd += bonds.of(middle, b).weight * e[0] * e[0] * e[0] * e[1];
      of_axes += bonds.gradient(middle, b) != Point{};
      ++weights[known(bonds.of(middle, b).weight)];
    }
    for (int a = 0; a < 3; ++a)
      for (int k = 0; k < 3; ++k) CHECK(moment[a][k] == relative(a == k ? 3 : 1, 1e-9));
    CHECK(std::abs(odd) < 1e-9);
    CHECK(of_axes == 6);
    CHECK(weights[2.0 / 3] == 18);
    CHECK(weights[3.0 / 8] == 8);
  }

  TEST_CASE("bonds: in 3D the gradient of a linear field is exact, at surfaces, tips and clamps too") {
    for (const Scene& scene : {ball(), block_with_tip(), clamped_block(4, 3, 3), block_on_faces(4, 3, 3)}) {
      const InitialParticles initial = make_initial_particles(scene);
      const Bonds bonds = make_bonds(scene, initial, h_over_dp * dp);
      for (int i = 0; i < initial.size(); ++i) {
        if (initial.clamped[i] && !scene.bodies[0].on_boundary) continue;
        Square one = Square::Zero();
        for (int b = bonds.begin[i]; b < bonds.begin[i + 1]; ++b)
          one += Eigen::Vector3d(bonds.of(i, b).X.data()) * Eigen::RowVector3d(bonds.gradient(i, b).data());
        CHECK((one - Square::Identity()).cwiseAbs().maxCoeff() < 1e-12);
      }
    }
  }

  TEST_CASE("bonds: in 3D volumes and masses sum to the body's, with an end correction at faces") {
    for (const Scene& scene : {block(5, 4, 3), ball(), block_on_faces(5, 4, 3)}) {
      const InitialParticles initial = make_initial_particles(scene);
      const Bonds bonds = make_bonds(scene, initial, h_over_dp * dp);
      const Snapshot start = make_simulation(scene, with_method("oenog"))->snapshot();
      const double density = scene.materials[0].density;
      CHECK(sum(bonds.volume) == relative(sum(initial.V0), 1e-13));
      CHECK(sum(start.m) == relative(density * sum(initial.V0), 1e-13));
      for (int i = 0; i < initial.size(); ++i) CHECK(start.m[i] == relative(density * bonds.mass[i], 1e-14));
    }
    // added first moment per face area: dp²/15 in volumes and dp²/24 in masses; with particles on faces −dp²/25 and 0
    for (const bool on_faces : {false, true}) {
      CAPTURE(on_faces);
      const int n = on_faces ? 8 : 9;
      const Scene scene = on_faces ? block_on_faces(n, n, n) : block(n, n, n);
      const InitialParticles initial = make_initial_particles(scene);
      const Bonds bonds = make_bonds(scene, initial, h_over_dp * dp);
      const double middle = 0.5 * n * dp;
      double moment = 0, of_mass = 0;
      for (int i = 0; i < initial.size(); ++i) {
        const Point& x = initial.x[i];
        if (std::abs(x[0] - middle) > 0.1 * dp || std::abs(x[1] - middle) > 0.1 * dp) continue;
        moment += (bonds.volume[i] - initial.V0[i]) * std::abs(x[2] - middle);
        of_mass += (bonds.mass[i] - initial.V0[i]) * std::abs(x[2] - middle);
      }
      const double face = 2 * dp * dp * dp * dp;
      CHECK(moment == relative(face * (on_faces ? -1.0 / 25 : 1.0 / 15), 1e-9));
      CHECK(std::abs(of_mass - (on_faces ? 0 : face / 24)) < 1e-9 * face);
    }
  }

  TEST_CASE("oenog: in 3D each material of a body has its mass, also in a skin of one layer") {
    Scene scene = block(6, 6, 6);
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].density *= 10;
    scene.bodies[0].parts = {
        {.material = 1, .where = [](const Point& X) { return X[2] > 5 * dp ? 1.0 : 0.0; }}};
    const Snapshot start = make_simulation(scene, with_method("oenog"))->snapshot();
    double of[2] = {};
    for (std::size_t i = 0; i < start.size(); ++i) of[start.material[i]] += start.m[i];
    const double layer = scene.materials[0].density * 36 * dp * dp * dp;
    CHECK(of[0] == relative(5 * layer, 1e-12));
    CHECK(of[1] == relative(10 * layer, 1e-12));
  }

  TEST_CASE("oenog: in 3D only particles beside a clamp store bonds of their own") {
    Scene scene = block(12, 12, 12);
    CHECK(make_bonds(scene, make_initial_particles(scene), h_over_dp * dp).rows.empty());
    scene.bodies[0].clamped = [](const Point& X) { return X[0] < 2 * dp ? 1.0 : 0.0; };
    CHECK(make_bonds(scene, make_initial_particles(scene), h_over_dp * dp).rows.size() ==
          3 * 34 * 34 - 12 * 12);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("oenog: in 3D a homogeneous strain leaves no force inside a lattice and a ball cut from it") {
    // volumes near a face give forces in four rows
    const auto deep = [](const Point& X) {
      return std::ranges::all_of(X, [](double x) { return std::abs(x - 5 * dp) < 0.6 * dp; });
    };
    CHECK(unbalanced(block(10, 10, 10), deep) < 1e-10);
    const auto deep_in_ball = [](const Point& X) { return std::hypot(X[0], X[1], X[2]) < 1.8 * dp; };
    CHECK(unbalanced(alone(Disc{{}, 0.0072}), deep_in_ball) < 1e-10);
  }

  TEST_CASE("oenog: in 3D a uniform strain leaves no force in front of a clamp") {
    const Scene scene = clamped_block(7, 10, 10);
    const auto before = [](const Point& X) {
      return X[0] > 0 && X[0] < 2 * dp && std::abs(X[1] - 5 * dp) < 0.6 * dp &&
             std::abs(X[2] - 5 * dp) < 0.6 * dp;
    };
    const double G = scene.materials[0].shear_modulus();
    const InitialParticles initial = make_initial_particles(scene);
    const Naive naive(scene, h_over_dp);
    double greatest = 0;
    for (int along = 0; along < 3; ++along) {
      constexpr double size = 0.05;  // of strains that keep the clamped face fixed
      Square F = Square::Identity();
      F(along, 0) += size;
      const auto force = naive.force(deformed(initial, F));
      for (int i = 0; i < naive.size(); ++i)
        for (int k = 0; k < 3 && before(initial.x[i]); ++k)
          greatest = std::max(greatest, std::abs(force[i][k]) / (G * size * dp * dp));
    }
    CHECK(greatest < 1e-10);
  }

  TEST_CASE("oenog: in 3D the energy of a homogeneous strain is neo-Hookean") {
    const Scene scene = ball();
    const InitialParticles initial = make_initial_particles(scene);
    const Material& material = scene.materials[0];
    const Naive naive(scene, h_over_dp);
    std::mt19937 random(5);
    for (int k = 0; k < 5; ++k) {
      const Square F = Square::Identity() + 0.2 * random_matrix(random);
      const double J = F.determinant();
      const double W = material.shear_modulus() / 2 * (std::pow(J, -2.0 / 3) * F.squaredNorm() - 3) +
                       material.bulk_modulus() / 2 * (J - 1) * (J - 1);
      CHECK(std::abs(naive.energy(deformed(initial, F)) / (W * sum(initial.V0)) - 1) < 1e-12);
    }
  }
}

TEST_SUITE("reference") {
  TEST_CASE("oenog: in 3D forces are minus the slopes of the energy") {
    Scene scene = small_clamped_block();
    scene.bodies.pop_back();
    const Naive naive = strained(scene, 15);
    const auto force = naive.force(naive.x);
    double greatest = 0, difference = 0;
    for (int i = 0; i < naive.size(); i += 2) {
      for (int k = 0; k < 3 && !naive.clamped(i); ++k) {
        const double step = 1e-5 * dp;
        auto there = naive.x;
        there[i][k] += step;
        const double above = naive.energy(there);
        there[i][k] -= 2 * step;
        const double slope = (above - naive.energy(there)) / (2 * step);
        difference = std::max(difference, std::abs(slope + force[i][k]));
        greatest = std::max(greatest, std::abs(slope));
      }
    }
    CHECK(greatest > 0);
    CHECK(difference < 1e-6 * greatest);
  }
}

TEST_SUITE("term") {
  TEST_CASE("oenog: in 3D a rotated strained body keeps its energy, and its forces rotate with it") {
    const Scene scene = shaken_block();
    const Naive naive = strained(scene, 30);
    const double energy = naive.energy(naive.x);
    REQUIRE(energy > 0);
    std::mt19937 random(11);
    for (int k = 0; k < 3; ++k) {
      const Square R = random_rotation(random);
      const auto turned = [&](Naive::Places a) {
        for (auto& p : a) {
          const Eigen::Vector3d x = R * Eigen::Vector3d(p.data());
          p = {x[0], x[1], x[2]};
        }
        return a;
      };
      CHECK(naive.energy(turned(naive.x)) == relative(energy, 1e-10));
      const auto after = naive.force(turned(naive.x)), before = turned(naive.force(naive.x));
      double difference = 0, greatest = 0;
      for (int i = 0; i < naive.size(); ++i)
        for (int a = 0; a < 3; ++a) {
          difference = std::max(difference, std::abs(after[i][a] - before[i][a]));
          greatest = std::max(greatest, std::abs(after[i][a]));
        }
      CHECK(difference < 1e-10 * greatest);
    }
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("oenog: in 3D colliding blocks conserve their momenta and, undamped, the energy") {
    Scene scene = two_blocks();
    for (const auto& [law, damping] :
         {std::pair(ContactLaw::surface, 0.01), {ContactLaw::surface, 0.0}, {ContactLaw::penalty, 0.0}}) {
      CAPTURE(std::string(name(law)));
      CAPTURE(damping);
      scene.contact = law;
      Settings settings = with_damping(damping);
      settings.cfl = 0.32;  // half the default, for smaller energy oscillations
      const auto simulation = make_simulation(scene, settings);
      const Snapshot first = simulation->snapshot();
      const Balance start = balance(first, scene);
      double most_strained = 0;
      for (int k = 0; k < 20; ++k) {
        make_steps(*simulation, 40);
        const Balance now = balance(simulation->snapshot(), scene);
        most_strained = std::max(most_strained, now.strain);
        for (std::size_t a = 0; a < 3; ++a) {
          CHECK(std::abs(now.linear_momentum[a] - start.linear_momentum[a]) < 1e-12 * now.momentum_scale);
          CHECK(std::abs(now.angular_momentum[a] - start.angular_momentum[a]) < 1e-12 * now.angular_scale);
        }
        if (damping == 0) CHECK(now.kinetic + now.strain == relative(start.kinetic, 2e-3));
      }
      CHECK(most_strained > 0.1 * start.kinetic);
      const Balance end = balance(simulation->snapshot(), scene);
      if (damping > 0) CHECK(end.kinetic + end.strain < 0.99 * start.kinetic);
      CHECK(simulation->snapshot().v[0] < 0.5 * first.v[0]);
    }
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("oenog: in 3D 1, 2 and 3 threads give the same bytes") {
    const Scene scene = two_blocks();
    Settings settings = with_method("oenog");
    const Snapshot one = state_after(60, scene, settings);
    for (const int threads : {2, 3}) {
      settings.threads = threads;
      CHECK(same_bytes(state_after(60, scene, settings), one));
    }
  }

  TEST_CASE("oenog: in 3D a resumed run of a strongly compressed cube gives the same bytes") {
    const Scene scene = cube_at_wall();
    const auto before = make_simulation(scene, with_method("oenog"));
    make_steps(*before, 30);
    const auto after = make_simulation(scene, with_method("oenog"));
    after->load(before->save());
    CHECK(after->steps() == 30);
    CHECK_FALSE(same_bytes(after->snapshot(), make_simulation(scene, with_method("oenog"))->snapshot()));
    make_steps(*before, 30), make_steps(*after, 30);
    CHECK(same_bytes(after->snapshot(), before->snapshot()));
  }
}

TEST_SUITE("convergence") {
  TEST_CASE(
      "oenog: in 3D the bending and torsion periods of a square cantilever approach those of finite elements") {
    constexpr double bending = 0.27691, torsion = 0.032507;
    const auto near = [](double error, double bound) { CHECK(std::abs(error) < bound); };
    near(error_of_period(bending_cantilever(3), bending), 0.03);
    near(error_of_period(bending_cantilever(5), bending), 0.01);
    near(error_of_period(twisting_cantilever(3), torsion), 0.11);
    near(error_of_period(twisting_cantilever(5), torsion), 0.02);
  }
}

TEST_SUITE("failure") {
  TEST_CASE(
      "oenog: in 3D thin bars on the lattice are stable at the default step for extreme Poisson's ratios") {
    struct Bar {
      double side, poisson_ratio;  // side in spacings
    };
    for (const auto [side, poisson_ratio] : {Bar{3, 0.495}, {3, -0.7}, {2, 0.499}}) {
      CAPTURE(side);
      CAPTURE(poisson_ratio);
      constexpr double bar_dp = 0.1;
      Scene scene;
      scene.name = "thin-bar";
      scene.dim = 3;
      scene.spacing = bar_dp;
      scene.materials = {{"soft", 1000, 1e5, poisson_ratio}};
      Body bar;
      bar.name = "bar";
      bar.shapes = {Box{{0, 0, 0}, {6 * bar_dp, side * bar_dp, side * bar_dp}}};
      bar.clamped = [](const Point& x) { return x[0] < bar_dp ? 1.0 : 0.0; };
      bar.velocity[0] = [](const Point& x) { return 0.02 * x[1]; };
      bar.velocity[1] = [](const Point& x) { return 0.05 * x[0] * x[0]; };
      bar.velocity[2] = [](const Point& x) { return 0.03 * x[0] * x[2]; };
      scene.bodies = {bar};
      const auto simulation = make_simulation(scene, with_method("oenog"));
      const Balance start = balance(simulation->snapshot(), scene);
      simulation->advance_to(0.2);
      const Balance end = balance(simulation->snapshot(), scene);
      CHECK(end.kinetic + end.strain <= start.kinetic);
    }
  }

  TEST_CASE("oenog: in 3D a cube that hits a wall at 0.9 sound speeds stays whole and finite") {
    const Scene scene = cube_at_wall();
    const auto simulation = make_simulation(scene, with_method("oenog"));
    Judge judge(scene, *simulation);
    double most_strained = 0, start = balance(simulation->snapshot(), scene).kinetic;
    for (int k = 0; k < 30; ++k) {
      make_steps(*simulation, 20);
      const Balance now = balance(simulation->snapshot(), scene);
      most_strained = std::max(most_strained, now.strain);
      judge.observe(simulation->snapshot(), now);
    }
    CHECK(judge.verdict() == Verdict::stable);
    CHECK(judge.pieces() == 1);
    CHECK(most_strained > 0.3 * start);
    CHECK(balance(simulation->snapshot(), scene).linear_momentum[0] > 0);
  }
}

}  // namespace of_this_file
