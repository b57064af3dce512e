
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/tensor.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/measures.hpp"
#include "engine/methods/bonded/cancelled.hpp"
#include "engine/methods/bonded/methods.hpp"
#include "engine/methods/bonded/packed_bonds.hpp"
#include "engine/scene/shapes/polygon.hpp"
#include "tests/engine/methods/bonded/naive_oenog.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double damping = 0.01;

Scene clamped_plate_of_two_materials() {
  Scene scene = small_clamped_plate();
  scene.bodies.pop_back();
  scene.materials.push_back({"soft", /*ρ0*/ 900, /*E*/ 4e6, /*ν*/ 0.3});
  scene.bodies[0].parts = {{1, [](const Point& x) { return x[0] > 0.008 ? 1.0 : 0.0; }}};
  return scene;
}

Scene auxetic_plate() {
  Scene scene = clamped_plate_of_two_materials();
  scene.name = "auxetic-plate";
  scene.materials[0].poisson_ratio = -0.3, scene.materials[1].poisson_ratio = -0.1;
  return scene;
}

Scene ring_alone() {
  Scene scene = small_collision();
  scene.bodies.pop_back();
  return scene;
}

/// Checks random bonds on a lattice with oblong cells, then with another bond off the lattice.
template <int Dim, class Kept>
void check_cancelled(double precision) {
  using Cancelled = CancelledBonds<Dim, Kept>;
  std::mt19937 random(5);
  const auto number = [&] { return std::generate_canonical<double, 53>(random); };
  const double pitch[3] = {1, 1.3, 0.8};
  std::vector<std::vector<CancelledTerm>> of_particle(lanes);
  for (auto& bonds : of_particle)
    for (int n = 0; n < (Dim == 2 ? 9 : 27); ++n)
      if (const Point X{(n % 3 - 1) * pitch[0], (n / 3 % 3 - 1) * pitch[1], (n / 9 - 1) * pitch[2]};
          n != (Dim == 2 ? 4 : 13) && number() < 0.8)
        bonds.push_back({X, 0.2 + number()});
  for (const bool on_lattice : {true, false}) {
    if (!on_lattice) of_particle[2].push_back({{0.3, 0.7, 0.2}, 0.2 + number()});
    Sym<Pack, Dim> C;
    for (Pack& c : C.c) c = Pack{number(), number(), number(), number()} - 0.5;
    for (int k = 0; k < Dim; ++k) C(k, k) += 1.5;
    const Cancelled owner(lanes, 1, [&](int i) { return of_particle[i]; });
    const auto cancelled = owner.view();
    Sym<Pack, Dim> identity{};
    for (int k = 0; k < Dim; ++k) identity(k, k) += 1;
    for (const Pack& c : cancelled.slopes(0, identity).c)
      for (int lane = 0; lane < lanes; ++lane) CHECK(std::abs(c[lane]) < 1e-14);
    const Sym<Pack, Dim> S = cancelled.slopes(0, C);
    for (int lane = 0; lane < lanes; ++lane) {
      Sym<double, Dim> expected{};
      for (const auto& [X, strength] : of_particle[lane]) {
        double s = 0, r2 = 0;
        for (int k = 0; k < Dim; ++k) r2 += X[k] * X[k];
        Sym<double, Dim> dyad;
        for (int a = 0; a < Dim; ++a)
          for (int k = a; k < Dim; ++k) dyad(a, k) = X[a] * X[k] / r2;
        for (int a = 0; a < Dim; ++a)
          for (int k = 0; k < Dim; ++k) s += dyad(a, k) * C(a, k)[lane];
        expected += (strength * cancelled_slope<Dim>(s)) * dyad;
      }
      for (int k = 0; k < expected.size; ++k) CHECK(S.c[k][lane] == Approx(expected.c[k]).epsilon(precision));
    }
  }
}

template <class Packed, int Dim>
void check_both_ends(const Scene& scene) {
  CAPTURE(scene.name);
  const InitialParticles initial = make_initial_particles(scene);
  std::vector<int> ids(initial.size());
  std::iota(ids.begin(), ids.end(), 0);
  std::vector<Elasticity> materials(scene.materials.size());
  for (std::size_t k = 0; k < materials.size(); ++k)
    materials[k].rho0 = scene.materials[k].density, materials[k].K = scene.materials[k].bulk_modulus(),
    materials[k].G = scene.materials[k].shear_modulus();
  Constants constants;
  constants.dp = scene.spacing, constants.h = oenog.h_over_dp * scene.spacing;
  const BondedSetup setup = make_bonded_setup(
      {oenog, scene, initial, constants, materials, Law{}, ContactLaw{}, false, {}, 1}, /*damping*/ 0);
  const Packed owner(setup, ids);
  const auto packed = owner.view();
  std::map<std::pair<int, int>, std::pair<double, Vec<double, Dim>>> seen;
  for (int first = 0; first < initial.size(); first += lanes) {
    const auto& own = packed.of(first / lanes);
    for (int b = 0; b < own.a_count; ++b) {
      const Pack k = packed.springs(own)[b].third();
      const Vec<Pack, Dim> a = unpacked(packed.a_ij(own)[b]);
      for (int lane = 0; lane < lanes; ++lane)
        if (k[lane] != 0)
          seen[{first + lane, first + packed.slots(own)[b].step[lane]}] = {k[lane], lane_of(a, lane)};
    }
  }
  int both = 0;
  for (const auto& [ends, own] : seen) {
    const auto other = seen.find({ends.second, ends.first});
    if (other == seen.end()) continue;  // the bond ends on the face of a clamp
    ++both;
    CHECK(own.first == other->second.first);
    for (int k = 0; k < Dim; ++k) CHECK(own.second[k] == -other->second.second[k]);
  }
  CHECK(both > 6 * initial.size() / 2);
}

}  // namespace

TEST_SUITE("reference") {
  TEST_CASE("oenog: 40 steps of clamped two-material plates and a ring agree with a plain implementation") {
    for (const Scene& scene : {clamped_plate_of_two_materials(), auxetic_plate(), ring_alone()}) {
      CAPTURE(scene.name);
      NaiveOenog naive(scene, oenog.h_over_dp);
      for (int step = 0; step < 40; ++step) naive.step(oenog.cfl, damping);
      const Snapshot now = state_after(40, scene, with_method("oenog"));
      double difference = 0, fastest = 0, moved = 0;
      for (int i = 0; i < naive.size(); ++i) {
        for (int k = 0; k < 2; ++k) {
          difference = std::max(difference, std::abs(naive.v[i][k] - now.v[2 * i + k]));
          fastest = std::max(fastest, std::abs(now.v[2 * i + k]));
          moved = std::max(moved, std::abs(now.x[2 * i + k] - now.x0[2 * i + k]));
        }
      }
      CHECK(difference < 1e-10 * fastest);
      CHECK(moved > 0.3 * scene.spacing);
      double energy = 0;
      for (const double e : now.strain_energy) energy += e;
      CHECK(energy == relative(naive.energy(naive.x), 1e-9));
    }
  }

  TEST_CASE("oenog: forces are minus the slopes of the energy") {
    const Scene scene = clamped_plate_of_two_materials();
    NaiveOenog naive(scene, oenog.h_over_dp);
    for (int step = 0; step < 40; ++step) naive.step(oenog.cfl, damping);
    const auto force = naive.force(naive.x);
    double greatest = 0, difference = 0;
    for (int i = 0; i < naive.size(); ++i) {
      for (int k = 0; k < 2 && !naive.clamped(i); ++k) {
        auto there = naive.x;
        const double step = 1e-5 * scene.spacing;
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
    check_field("force by hand", flat(naive.force_by_hand(naive.x)), flat(force));
  }
}

TEST_SUITE("term") {
  TEST_CASE("bonds: weights of face terms sum to zero and have the exact first moment") {
    for (const double nu : {0.0, 0.3, 0.49}) {
      CAPTURE(nu);
      Scene scene = small_clamped_plate();
      scene.bodies.pop_back();
      scene.materials[0].poisson_ratio = nu;
      const InitialParticles initial = make_initial_particles(scene);
      const Bonds bonds = make_bonds(scene, initial, oenog.h_over_dp * scene.spacing);
      std::map<long, std::array<double, 2>> of_column;  // Σ w, Σ w |y|
      for (const FaceTerm& term : bonds.face_terms) {
        if (std::abs(term.t[0]) < std::abs(term.t[1])) continue;
        CHECK(std::abs(term.t[1]) < 1e-12 * std::abs(term.t[0]));
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
              .face_terms.empty());  // more than eight neighbours
  }

  TEST_CASE("bond: four packed particles have the cancelled stress of single particles") {
    check_cancelled<2, AlignedPack>(1e-12);
    check_cancelled<3, AlignedPack>(1e-12);
    check_cancelled<3, HalfPack>(1e-6);
  }

  TEST_CASE("oenog: a rotated strained body keeps its energy, and its forces rotate with it") {
    const Scene scene = ring_alone();
    NaiveOenog naive(scene, oenog.h_over_dp);
    for (int step = 0; step < 40; ++step) naive.step(oenog.cfl, damping);
    const double c = std::cos(2.1), s = std::sin(2.1);
    const auto turned = [&](const NaiveOenog::Places& a) {
      NaiveOenog::Places out;
      for (const auto& p : a) out.push_back({c * p[0] - s * p[1], s * p[0] + c * p[1]});
      return out;
    };
    REQUIRE(naive.energy(naive.x) > 0);
    CHECK(naive.energy(turned(naive.x)) == relative(naive.energy(naive.x), 1e-10));
    const auto after = naive.force(turned(naive.x)), before = turned(naive.force(naive.x));
    double difference = 0, greatest = 0;
    for (int i = 0; i < naive.size(); ++i)
      for (int k = 0; k < 2; ++k) {
        difference = std::max(difference, std::abs(after[i][k] - before[i][k]));
        greatest = std::max(greatest, std::abs(after[i][k]));
      }
    CHECK(difference < 1e-10 * greatest);
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("oenog: both ends of a bond have the same strength to the last bit and opposite areas") {
    for (const Scene& scene : {clamped_plate_of_two_materials(), ring_alone()})
      check_both_ends<PackedBonds<2, AlignedPack>, 2>(scene);
    check_both_ends<PackedBonds<3, AlignedPack>, 3>(small_clamped_block());
    check_both_ends<PackedBonds<3, HalfPack>, 3>(jittered(small_clamped_block(), 0.2));
  }

  TEST_CASE("oenog: a body of two materials conserves its momenta and its energy") {
    Scene scene = rotating_plate(0.2);
    scene.materials.push_back({"soft", /*ρ0*/ 900, /*E*/ 4e6, /*ν*/ 0.3});
    scene.bodies[0].parts = {{1, [](const Point& x) { return x[1] > 0.002 ? 1.0 : 0.0; }}};
    Settings undamped = with_method("oenog");
    undamped.constants["damping"] = 0;
    const auto simulation = make_simulation(scene, undamped);
    const Balance before = balance(simulation->snapshot(), scene);
    make_steps(*simulation, 300);
    const Balance after = balance(simulation->snapshot(), scene);
    CHECK(after.angular_momentum[2] == relative(before.angular_momentum[2], 1e-12));
    CHECK(std::abs(after.linear_momentum[0] - before.linear_momentum[0]) < 1e-12 * before.momentum_scale);
    CHECK(after.kinetic + after.strain == relative(before.kinetic, 2e-3));
    CHECK(after.strain > 0.005 * before.kinetic);
  }
}

TEST_SUITE("term") {
  TEST_CASE("oenog: damping removes a zigzag and leaves the first mode nearly unchanged") {
    Scene zigzag = rotating_plate(0);
    const double c0 = ring_rubber().sound_speed(), dp = zigzag.spacing;
    const auto parity = [dp](double x) { return std::lround(std::floor(x / dp)) % 2 == 0 ? 1.0 : -1.0; };
    zigzag.bodies[0].velocity[0] = [=](const Point& x) { return 1e-3 * c0 * parity(x[1]); };
    zigzag.bodies[0].velocity[1] = [=](const Point&) { return 0.0; };
    const auto kept = [](const Scene& scene, double from, double to, double damping) {
      Settings settings = with_method("oenog");
      settings.constants["damping"] = damping;
      const auto simulation = make_simulation(scene, settings);
      const auto energy_at = [&](double t) {
        simulation->advance_to(t);
        const Balance now = balance(simulation->snapshot(), scene);
        return now.kinetic + now.strain;
      };
      const double start = energy_at(from);
      return energy_at(to) / start;
    };
    const double shear_speed = std::sqrt(ring_rubber().shear_modulus() / ring_rubber().density);
    const double period = std::numbers::pi * dp / shear_speed;  // rows move against each other: ω = 2 c_s/dp
    CHECK(kept(zigzag, 0, 18 * period, 0) > 0.95);
    CHECK(kept(zigzag, 0, 18 * period, damping) < 0.12);
    // after one period only the first mode is left
    const Scene plate = oscillating_plate(0.001, 5);
    CHECK(kept(plate, 0.25, 0.5, damping) > 0.999);
    CHECK(kept(plate, 0.25, 0.5, damping) < 1);
  }
}

namespace {

/// Initial velocities L x, so fast that surface waves do not reach the middle.
Scene straining_block(const Mat<double, 2>& L) {
  Scene scene = rotating_plate(0);
  for (const int axis : {0, 1})
    scene.bodies[0].velocity[static_cast<std::size_t>(axis)] = [=](const Point& x) {
      return L(axis, 0) * x[0] + L(axis, 1) * x[1];
    };
  return scene;
}

Mat<double, 2> gradient(const Snapshot& now) {
  const auto corner = [&](double X, double Y) {
    for (std::size_t i = 0; i < now.size(); ++i)
      if (std::hypot(now.x0[2 * i] - X, now.x0[2 * i + 1] - Y) < 1e-9) return i;
    FAIL("there is no particle at this place");
    return now.size();
  };
  const double half = 0.0005;
  const std::size_t low = corner(-half, -half), right = corner(half, -half), up = corner(-half, half);
  Mat<double, 2> F;
  for (int a = 0; a < 2; ++a) {
    const auto at = [&](std::size_t i) { return now.x[2 * i + a]; };
    F(a, 0) = (at(right) - at(low)) / (2 * half), F(a, 1) = (at(up) - at(low)) / (2 * half);
  }
  return F;
}

std::size_t middle_of(const Snapshot& now) {
  std::size_t middle = 0;
  const auto from = [&](std::size_t i) { return std::hypot(now.x0[2 * i], now.x0[2 * i + 1]); };
  for (std::size_t i = 0; i < now.size(); ++i)
    if (from(i) < from(middle)) middle = i;
  return middle;
}

}  // namespace

TEST_SUITE("analytic") {
  TEST_CASE("oenog: output pressure and stress are neo-Hookean, and the density is ρ0/J") {
    const Material rubber = ring_rubber();
    const double rate = rubber.sound_speed() / 0.01, K = rubber.bulk_modulus(), G = rubber.shear_modulus();
    Mat<double, 2> drawn, pressed, shut;
    drawn(0, 0) = 0.8, drawn(0, 1) = 0.5, drawn(1, 0) = -0.2, drawn(1, 1) = 0.3;
    pressed(0, 0) = -1, pressed(0, 1) = 0.4, pressed(1, 0) = 0.7, pressed(1, 1) = 0.1;
    shut(0, 0) = -3, shut(1, 1) = -3.5, shut(0, 1) = 0.3, shut(1, 0) = 0.1;
    for (const Mat<double, 2>& L : {drawn, pressed, shut}) {
      const Snapshot now = state_after(8, straining_block(rate * L), with_method("oenog"));
      const Mat<double, 2> F = gradient(now);
      const double J = determinant(F), scale = G * std::pow(J, -5.0 / 3);
      CAPTURE(J);
      CHECK(std::abs(J - 1) > 0.1);
      const double xx = F(0, 0) * F(0, 0) + F(0, 1) * F(0, 1), yy = F(1, 0) * F(1, 0) + F(1, 1) * F(1, 1);
      const double xy = F(0, 0) * F(1, 0) + F(0, 1) * F(1, 1), mean = (xx + yy + 1) / 3;
      const std::size_t i = middle_of(now);
      const StressTensor s = now.deviator(i);
      const auto close = [&](double value, double expected) {
        CHECK(std::abs(value - expected) < 1e-6 * (K + G));
      };
      CHECK(now.rho[i] == relative(rubber.density / J, 1e-6));
      close(now.p[i], -K * (J - 1));
      close(s.xx, scale * (xx - mean));
      close(s.xy, scale * xy);
      close(s.yy, scale * (yy - mean));
      close(s.zz, scale * (1 - mean));
      CHECK(std::abs(s.xy) > 0.01 * G);
    }
  }

  TEST_CASE("oenog: a rotated wedge has no stress, even at its tip, whose bonds are nearly collinear") {
    Scene scene = ring_alone();
    const Chain wedge{{0, 0, 0}, {0.02, -0.0035, 0}, {0.02, 0.0035, 0}};
    scene.bodies[0].shapes = {Polygon({wedge})};
    scene.bodies[0].velocity = {};
    scene.spacing = 0.001;
    scene.bodies[0].displacement[0] = [](const Point& X) { return -X[1] - X[0]; };
    scene.bodies[0].displacement[1] = [](const Point& X) { return X[0] - X[1]; };
    const Snapshot now = make_simulation(scene, with_method("oenog"))->snapshot();
    const double K = ring_rubber().bulk_modulus();
    for (std::size_t i = 0; i < now.size(); ++i) {
      const StressTensor s = now.deviator(i);
      for (const double component : {s.xx, s.xy, s.yy, s.zz}) CHECK(std::abs(component) < 1e-9 * K);
      CHECK(std::abs(now.p[i]) < 1e-9 * K);
      CHECK(now.rho[i] == relative(ring_rubber().density, 1e-9));
    }
  }

  TEST_CASE(
      "oenog: the strain energy equals the material law up to stretch 2.4 (3D: 1.95), and exceeds it beyond") {
    const Material rubber = ring_rubber();
    for (const int dim : {2, 3}) {
      for (const double stretch : {1.5, 1.95, 2.4, 2.8}) {
        CAPTURE(dim);
        CAPTURE(stretch);
        const double waist = 0.7;
        Scene scene = ring_alone();
        scene.dim = dim;
        scene.bodies[0].shapes = {Box{{0, 0, 0}, {0.008, 0.006, dim == 3 ? 0.005 : 0}}};
        scene.bodies[0].velocity = {};
        scene.bodies[0].displacement = {[=](const Point& x) { return (stretch - 1) * x[0]; },
                                        [=](const Point& x) { return (waist - 1) * x[1]; },
                                        [=](const Point& x) { return (waist - 1) * x[2]; }};
        const Snapshot now = make_simulation(scene, with_method("oenog"))->snapshot();
        const double depth = dim == 3 ? waist : 1, J = stretch * waist * depth;
        const double I = stretch * stretch + waist * waist + depth * depth;
        const double W = rubber.shear_modulus() / 2 * (std::pow(J, -2.0 / 3) * I - 3) +
                         rubber.bulk_modulus() / 2 * (J - 1) * (J - 1);
        const double energy = std::accumulate(now.strain_energy.begin(), now.strain_energy.end(), 0.0),
                     of_law = 0.008 * 0.006 * (dim == 3 ? 0.005 : 1) * W;
        if (stretch < (dim == 2 ? 2.5 : 2))
          CHECK(energy == relative(of_law, 1e-11));
        else
          CHECK(energy > 1.01 * of_law);
      }
    }
  }

  TEST_CASE("oenog: steps shorten with the stiffening of a body compressed below half its volume") {
    const Material rubber = ring_rubber();
    const double G = rubber.shear_modulus(), M = rubber.bulk_modulus() + 4 * G / 3;
    const double c = std::sqrt(M / rubber.density), rate = 4 * rubber.sound_speed() / 0.01;
    Mat<double, 2> L;
    L(0, 0) = L(1, 1) = -rate, L(0, 1) = L(1, 0) = 0;
    const Scene scene = straining_block(L);
    int shut = 0;
    for (int steps = 1; steps < 40 && shut < 2; ++steps) {
      const Snapshot before = state_after(steps - 1, scene, with_method("oenog")),
                     now = state_after(steps, scene, with_method("oenog")),
                     after = state_after(steps + 1, scene, with_method("oenog"));
      double J = 1;  // least J at mid-step, where forces are evaluated
      for (std::size_t i = 0; i < now.size(); ++i) {
        const auto root = [&](const Snapshot& at) { return std::sqrt(rubber.density / at.rho[i]); };
        J = std::min(J, std::pow(0.5 * (root(before) + root(now)), 2));
      }
      if (J > 0.4) continue;
      ++shut;
      double fastest = 0;
      for (std::size_t i = 0; i < now.size(); ++i)
        fastest = std::max(fastest, std::hypot(now.v[2 * i], now.v[2 * i + 1]));
      const double shorter = oenog.cfl * scene.spacing / (c + fastest) / (after.time - now.time);
      // 1 + ∂²/∂J² of (1 − 2J)³; steps shorten where the stiffness exceeds 1.5 times its value at rest
      CHECK(1.5 * shorter * shorter == relative(1 + 24 * (1 - 2 * J), 0.02));
    }
    CHECK(shut == 2);
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("oenog: two rings stay mirror images of each other to the last bit") {
    const Scene scene = colliding_rings(0.06, 0.002);
    const auto simulation = make_simulation(scene, with_method("oenog"));
    simulation->advance_to(0.008);
    const Snapshot& now = simulation->snapshot();
    const std::size_t n = now.m.size() / 2;
    int different = 0;
    for (std::size_t i = 0; i < n; ++i)
      different += now.x[2 * i] != -now.x[2 * (i + n)] || now.x[2 * i + 1] != now.x[2 * (i + n) + 1];
    CHECK(different == 0);
    CHECK(now.strain_energy[0] > 0);
  }
}

TEST_SUITE("convergence") {
  TEST_CASE("plate: with five rows the period of oenog is within 3 % for Poisson's ratios from 0 to 0.49") {
    struct Plate {
      double nu, period;               // from finite elements
      std::vector<double> error = {};  // with 5 and 10 rows
    };
    for (const Plate& plate : {Plate{0, 0.27868, {0.016, 0.003}}, Plate{0.3, 0.26575, {0.007, 0.0015}},
                               Plate{0.3975, 0.25522, {0.003, 0.001}}, Plate{0.49, 0.2416, {0.028}}}) {
      CAPTURE(plate.nu);
      for (std::size_t k = 0; k < plate.error.size(); ++k) {
        Scene scene = oscillating_plate(0.001, 5 << k);
        scene.materials[0].poisson_ratio = plate.nu;
        Measure period;
        period.kind = "period";
        period.probes = {scene.probes[0].name};
        scene.measures = {period};
        const auto simulation = make_simulation(scene, with_method("oenog"));
        simulation->advance_to(1.1 * plate.period);
        const auto result = measure(scene, simulation->series(), "neo_hookean");
        REQUIRE(result[0].value);
        CHECK(std::abs(*result[0].value / plate.period - 1) < plate.error[k]);
      }
    }
  }
}

}  // namespace of_this_file
