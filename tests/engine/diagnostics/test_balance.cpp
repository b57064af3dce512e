#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/kernels_of.hpp"
#include "engine/diagnostics/alternating_part.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/kernels.hpp"
#include "engine/simulation.hpp"
#include "tests/support/made_snapshot.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;
using test::made_scene;
using test::made_snapshot;
using test::unit_bulk;

namespace {

Snapshot lively(int dim) {
  Snapshot now = made_snapshot(dim, {{0.3, 1.1, 0.2}, {-2, 0.7, 1.3}, {1.9, -0.4, -0.6}});
  for (std::size_t k = 0; k < now.v.size(); ++k) now.v[k] = std::sin(1.0 + 3.0 * static_cast<double>(k));
  for (std::size_t k = 0; k < now.s.size(); ++k) now.s[k] = std::cos(2.0 + 5.0 * static_cast<double>(k));
  now.p = {0.3, -1.7, 0.9};
  now.m = {2, 3, 5};
  now.rho = {1.1, 0.8, 1.3};
  now.body = {0, 1, 1};
  return now;
}

Scene two_materials(int dim) {
  return made_scene(dim, 1, {unit_bulk(), {"stiff", 1, /*E*/ 12, /*ν*/ 0.25}});  // K = 8, G = 4.8
}

void scale(std::vector<double>& values, double factor) {
  for (double& value : values) value *= factor;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("balance: one particle has the exact kinetic and strain energies") {
    const Scene scene = made_scene(2, 1, {unit_bulk()});  // K = 1, G = 1.5
    Snapshot now = made_snapshot(2, {{0, 0, 0}});
    now.m = {6};
    now.rho = {2};
    now.v = {3, -4};
    now.p = {-2};
    CHECK(balance(now, scene).kinetic == Approx(0.5 * 6 * 25));
    CHECK(balance(now, scene).strain == Approx(3 * 4 / 2.0));
    now.p = {0};
    now.s = {0, 2, 0, 0};
    CHECK(balance(now, scene).strain == Approx(3 * 4 / (2 * 1.5)));
    now.s = {0, 0, 0, 3};
    CHECK(balance(now, scene).strain == Approx(3 * 9 / (4 * 1.5)));
  }

  TEST_CASE("balance: a bar under tension σ has the strain energy σ²/2E per volume") {
    const Material rubber = {"rubber", 1200, 1e7, 0.4};
    const Scene scene = made_scene(3, 1, {rubber});
    Snapshot now = made_snapshot(3, {{0, 0, 0}});
    const double sigma = 3e5;
    now.p = {-sigma / 3};
    now.s = {2 * sigma / 3, 0, 0, -sigma / 3, 0, -sigma / 3};
    CHECK(balance(now, scene).strain == Approx(sigma * sigma / (2 * rubber.youngs_modulus)));
  }

  TEST_CASE("balance: each particle counts with its own material") {
    const Scene scene = two_materials(2);
    Snapshot now = made_snapshot(2, {{0, 0, 0}});
    now.p = {4};
    CHECK(balance(now, scene).strain == Approx(8));
    now.material = {1};
    CHECK(balance(now, scene).strain == Approx(1));
  }

  TEST_CASE("balance: rigid rotation about the centre has angular momentum I ω and no linear momentum") {
    const Scene scene = made_scene(2, 1, {unit_bulk()});
    Snapshot now = made_snapshot(2, {{1, 0, 0}, {-1, 0, 0}, {0, 2, 0}, {0, -2, 0}});
    const double omega = 3;
    for (std::size_t i = 0; i < now.size(); ++i) {
      now.v[2 * i] = -omega * now.x[2 * i + 1];
      now.v[2 * i + 1] = omega * now.x[2 * i];
    }
    const double inertia = 2 * 1 + 2 * 4;
    const Balance sums = balance(now, scene);
    CHECK(sums.angular_momentum[2] == Approx(inertia * omega));
    CHECK(sums.angular_momentum[0] == 0);
    CHECK(sums.angular_momentum[1] == 0);
    CHECK(sums.angular_scale == Approx(inertia * omega));
    CHECK(sums.linear_momentum == Point{});
    CHECK(sums.momentum_scale == Approx(2 * 3 + 2 * 6));
    CHECK(sums.kinetic == Approx(0.5 * inertia * omega * omega));
  }

  TEST_CASE("balance: angular momentum of a particle in space is x × m v") {
    const Scene scene = made_scene(3, 1, {unit_bulk()});
    Snapshot now = made_snapshot(3, {{1, 2, 3}});
    now.v = {4, 5, 6};
    now.m = {2};
    const Balance sums = balance(now, scene);
    CHECK(sums.angular_momentum == Point{-6, 12, -6});
    CHECK(sums.linear_momentum == Point{8, 10, 12});
  }

  TEST_CASE("balance: sums of terms of both signs keep digits that a plain sum loses") {
    const Scene scene = made_scene(2, 1, {unit_bulk()});
    Snapshot now = made_snapshot(2, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    now.v = {1, 0, 1e20, 0, 1, 0, -1e20, 0};
    CHECK(balance(now, scene).linear_momentum[0] == 2);
  }

#if defined(__x86_64__)
  TEST_CASE("particle loops: sums do not depend on the instruction set") {
    if (!has_x86_64_v3()) {
      MESSAGE("skipped: the processor lacks the instructions of x86-64-v3");
      return;
    }
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      std::vector<Point> places;
      for (int c = 0; c < 343; ++c)
        places.push_back({0.1 * (c % 7), 0.1 * (c / 7 % 7), dim == 3 ? 0.1 * (c / 49) : 0});
      Snapshot now = made_snapshot(dim, places);
      const AlternatingPart part = alternating_part(now, 0.1);
      for (std::vector<double>* field : {&now.x, &now.v, &now.p, &now.s})
        for (std::size_t k = 0; k < field->size(); ++k)
          (*field)[k] += std::sin(1.0 + 3.0 * static_cast<double>(k));
      std::vector<StrainDivisors> divisors;
      for (const Material& material : two_materials(dim).materials)
        divisors.push_back({2 * material.bulk_modulus(), 4 * material.shear_modulus()});
      const AlternatingView view{part.rows(), part.begin.data(), part.j.data(), part.first_weight.data(),
                                 part.weight.data()};
      const auto sums_by = [&](InstructionSet allowed) {
        const auto& kernels = best_kernels<SharedKernels::history_row, HistoryKernels>(dim, "", allowed);
        std::array<double, 16> sums;
        std::vector<double> squared(static_cast<std::size_t>(part.rows()));
        kernels.alternating_sums(view, view_of(now), 0.1, sums.data(), squared.data());
        kernels.balance(view_of(now), divisors.data(), 0, sums.data() + 6);
        return sums;
      };
      const auto any = sums_by(InstructionSet::baseline), best = sums_by(InstructionSet::x86_64_v4);
      CHECK(any[2] > 0);
      CHECK(any[7] > 0);
      CHECK(std::memcmp(&any, &best, sizeof any) == 0);
    }
  }
#endif

  TEST_CASE("balance: other units of length, time and mass rescale every sum") {
    const double length = 3, time = 0.25, mass = 7;
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      Snapshot now = lively(dim);
      Scene scene = two_materials(dim);
      const Balance before = balance(now, scene);
      const double pressure = mass / (time * time) / std::pow(length, dim - 2);
      scale(now.x, length);
      scale(now.v, length / time);
      scale(now.m, mass);
      scale(now.rho, mass / std::pow(length, dim));
      scale(now.p, pressure);
      scale(now.s, pressure);
      for (Material& material : scene.materials) material.youngs_modulus *= pressure;
      const Balance after = balance(now, scene);
      const double energy = mass * length * length / (time * time);
      CHECK(before.strain > 0.1);
      CHECK(after.kinetic == Approx(energy * before.kinetic));
      CHECK(after.strain == Approx(energy * before.strain));
      CHECK(after.momentum_scale == Approx(mass * length / time * before.momentum_scale));
      CHECK(after.angular_scale == Approx(mass * length * length / time * before.angular_scale));
      for (std::size_t a = 0; a < 3; ++a) {
        CHECK(after.linear_momentum[a] == Approx(mass * length / time * before.linear_momentum[a]));
        CHECK(after.angular_momentum[a] ==
              Approx(mass * length * length / time * before.angular_momentum[a]));
      }
    }
  }
}

}  // namespace of_this_file
