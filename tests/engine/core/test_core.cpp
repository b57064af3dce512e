#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/cube_root.hpp"
#include "engine/core/growth.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/team_size.hpp"
#include "engine/core/tensor.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

double scramble(int k) { return std::sin(1.0 + 2.7 * k) + 0.1 * k; }

/// Number of steps of 1 ms on one thread until all threads are tried again.
int steps_alone(TeamSize& team) {
  int steps = 0;
  for (; team.threads() == 1; ++steps) team.step_took(1e-3);
  return steps;
}

template <int Dim>
Sym<double, Dim> some_sym(int seed) {
  Sym<double, Dim> a;
  for (int k = 0; k < Sym<double, Dim>::size; ++k) a.c[k] = scramble(seed + k);
  return a;
}

template <int Dim>
Mat<double, Dim> some_mat(int seed) {
  Mat<double, Dim> a;
  for (int k = 0; k < Dim; ++k)
    for (int l = 0; l < Dim; ++l) a(k, l) = scramble(seed + Dim * k + l);
  return a;
}

template <int Dim>
void check_symmetric_tensor() {
  CAPTURE(Dim);
  int expected = 0;
  for (int a = 0; a < Dim; ++a) {
    for (int b = a; b < Dim; ++b) {
      CHECK(Sym<double, Dim>::index(a, b) == expected++);
      CHECK(Sym<double, Dim>::index(a, b) == Sym<double, Dim>::index(b, a));
    }
  }
  CHECK(expected == Sym<double, Dim>::size);

  const Sym<double, Dim> s = some_sym<Dim>(1);
  Vec<double, Dim> v;
  for (int k = 0; k < Dim; ++k) v[k] = scramble(40 + k);
  const Vec<double, Dim> sv = s * v;
  double diagonal = 0;
  for (int k = 0; k < Dim; ++k) {
    double row = 0;
    for (int l = 0; l < Dim; ++l) row += s.c[Sym<double, Dim>::index(std::min(k, l), std::max(k, l))] * v[l];
    CHECK(sv[k] == Approx(row));
    diagonal += s(k, k);
  }
  CHECK(trace(s) == Approx(diagonal));
}

template <int Dim>
void check_products() {
  CAPTURE(Dim);
  const Mat<double, Dim> A = some_mat<Dim>(3);
  const Sym<double, Dim> B = some_sym<Dim>(20);
  const Mat<double, Dim> C = product(A, B);
  Vec<double, Dim> a, b;
  for (int k = 0; k < Dim; ++k) a[k] = scramble(50 + k), b[k] = scramble(60 + k);
  Mat<double, Dim> outer = A;
  add_outer(outer, 2.0, a, b);
  Sym<double, Dim> square = B;
  add_outer(square, 3.0, a);
  for (int k = 0; k < Dim; ++k) {
    for (int l = 0; l < Dim; ++l) {
      double element = 0;
      for (int m = 0; m < Dim; ++m) element += A(k, m) * B(m, l);
      CHECK(C(k, l) == Approx(element));
      CHECK(outer(k, l) == Approx(A(k, l) + 2 * a[k] * b[l]));
      CHECK(square(k, l) == Approx(B(k, l) + 3 * a[k] * a[l]));
    }
  }
}

template <int Width>
void check_gather() {
  CAPTURE(Width);
  const int rows = 9;
  alignas(sizeof(Pack)) double table[rows * Width];
  for (int k = 0; k < rows * Width; ++k) table[k] = scramble(k);
  for (const auto& j : {std::array{0, 1, 2, 3}, std::array{8, 2, 2, 5}, std::array{7, 7, 7, 7}}) {
    Pack out[Width];
    gather<Width>(table, j.data(), out);
    for (int lane = 0; lane < lanes; ++lane)
      for (int k = 0; k < Width; ++k) CHECK(double{out[k][lane]} == table[j[lane] * Width + k]);
  }
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("cube root: the inverse cube root times the cube root is 1 for all sizes and both signs") {
    for (double x = 1e-290; x < 1e290; x *= 1.37) {
      CHECK(inverse_cube_root(x) * std::cbrt(x) == Approx(1).epsilon(1e-15));
      CHECK(inverse_cube_root(-x) == -inverse_cube_root(x));
    }
    for (double x = 1e-290; x < 1e290; x *= 1.37) {
      CHECK(inverse_cube_root(filled<Pack>(x))[2] * std::cbrt(x) == Approx(1).epsilon(1e-15));
      CHECK(inverse_cube_root(filled<Pack>(-x))[1] == -inverse_cube_root(filled<Pack>(x))[1]);
    }
    CHECK(inverse_cube_root(1) == 1);
    CHECK(std::isnan(inverse_cube_root(std::nan(""))));
  }

  TEST_CASE("tensor: a symmetric tensor is stored as its upper triangle") {
    check_symmetric_tensor<2>();
    check_symmetric_tensor<3>();
  }

  TEST_CASE("tensor: products equal sums over components") {
    check_products<2>();
    check_products<3>();
  }

  TEST_CASE("tensor: a symmetric tensor times its inverse is the identity in any unit") {
    for (const double scale : {1e-12, 1.0, 1e9}) {
      const Sym<double, 2> a = scale * Sym<double, 2>{2.0, -0.7, 1.3};
      const Sym<double, 2> b = inverse(a);
      CHECK(a(0, 0) * b(0, 0) + a(0, 1) * b(1, 0) == Approx(1));
      CHECK(a(1, 0) * b(0, 1) + a(1, 1) * b(1, 1) == Approx(1));
      CHECK(a(0, 0) * b(0, 1) + a(0, 1) * b(1, 1) == Approx(0).scale(1));
      CHECK(a(1, 0) * b(0, 0) + a(1, 1) * b(1, 0) == Approx(0).scale(1));
    }
  }

  TEST_CASE("tensor: the inverse of a singular tensor is 0") {
    Sym<double, 2> line{};
    add_outer(line, 0.3, Vec<double, 2>{0.6, 0.8});
    for (const Sym<double, 2>& a : {Sym<double, 2>{0, 0, 0}, line}) {
      const Sym<double, 2> b = inverse(a);
      for (const double component : b.c) CHECK(component == 0);
    }
  }

  TEST_CASE("tensor: a sum over lanes adds the lanes of each component") {
    const Vec<double, 3> v = {1.5, -2, 0.25};
    for (int k = 0; k < 3; ++k) CHECK(sum(spread(v))[k] == 4 * v[k]);
    const Vec<Pack, 3> lane_by_lane{Pack{1, 2, 3, 4}, Pack{10, 20, 30, 40}, Pack{100, 200, 300, 400}};
    for (int k = 0; k < 3; ++k) CHECK(sum(lane_by_lane)[k] == sum(lane_by_lane[k]));
    CHECK(sum(Vec<Pack, 2>{lane_by_lane[0], lane_by_lane[1]})[1] == 100);
    Mat<Pack, 2> m{};
    add_outer(m, Pack{1, 2, 3, 4}, spread(Vec<double, 2>{1, 2}), spread(Vec<double, 2>{3, 5}));
    CHECK(sum(m)(0, 1) == 10 * 5);
    CHECK(sum(m)(1, 0) == 10 * 6);
  }

  TEST_CASE("pack: four rows are gathered and transposed") {
    check_gather<4>();
    check_gather<8>();
  }

  TEST_CASE("pack: functions act on each lane") {
    const Pack a = {0.3, 4, 0, 7.7}, b = {1, -4, 0, 7.6};
    for (int lane = 0; lane < lanes; ++lane) {
      CHECK(root(a)[lane] == std::sqrt(a[lane]));
      CHECK(min(a, b)[lane] == std::min(a[lane], b[lane]));
      CHECK(max(a, b)[lane] == std::max(a[lane], b[lane]));
      CHECK(power<3>(b)[lane] == b[lane] * b[lane] * b[lane]);
      CHECK(filled<Pack>(2.5)[lane] == 2.5);
    }
    CHECK(sum(Pack{1, 20, 300, 4000}) == 4321);
    CHECK(any(a < 0.1));
    CHECK(!any(a < 0));
  }

  TEST_CASE("parallel: every index is visited once on any number of threads") {
    for (int again = 0; again < 50; ++again) {  // a late helper must not touch the next loop
      for (const int threads : {1, 2, 3, 8}) {
        for (const int n : {0, 1, 2, 100, 1000}) {
          std::vector<int> visits(n, 0);
          parallel_for(n, threads, [&](int i) { ++visits[i]; });
          CHECK(std::ranges::count(visits, 1) == n);
        }
      }
    }
  }

  TEST_CASE("parallel: a loop within a loop visits every index") {
    std::vector<std::atomic<int>> visits(100);
    parallel_for(100, 2, [&](int) { parallel_for(100, 2, [&](int k) { ++visits[k]; }); });
    for (const std::atomic<int>& count : visits) CHECK(count == 100);
  }

  TEST_CASE("parallel: a delayed helper does not block the other chunks") {
    const std::thread::id owner = std::this_thread::get_id();
    const int n = 1000;
    for (int again = 0; again < 50; ++again) {
      std::atomic<int> left = chunks_of(n, 2);
      REQUIRE(left == 8);
      std::atomic<bool> held_up = false;
      parallel_chunks(n, 2, [&](int, int, int) {
        --left;
        if (std::this_thread::get_id() == owner || held_up.exchange(true)) return;
        while (left > 0) std::this_thread::yield();  // loops for ever if one chunk waits for another
      });
      CHECK(left == 0);
    }
  }

  TEST_CASE("parallel: items made on several threads are taken once, in order, with at most 1024 in memory") {
    for (const int threads : {1, 3})
      for (const int n : {0, 1, 1024, 10000}) {
        CAPTURE(threads);
        CAPTURE(n);
        std::atomic<int> made = 0;
        int taken = 0, most = 0;
        make_in_order(
            n, threads,
            [&](int i) {
              ++made;
              return std::vector<int>(1, i);
            },
            [&](int i, const std::vector<int>& one) {
              CHECK(i == taken);
              CHECK(one == std::vector<int>(1, i));
              most = std::max(most, made - taken++);
            });
        CHECK(taken == n);
        CHECK(made == n);
        CHECK(most <= 1024);
      }
  }

  TEST_CASE("parallel: the maximum is the greatest value, or NaN if any value is NaN") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const int threads : {1, 2, 3}) {
      CAPTURE(threads);
      for (int special = 0; special < 10; ++special) {
        CAPTURE(special);
        CHECK(parallel_max(10, threads, [&](int i) { return i == special ? 5.0 : 0.1 * i; }) == 5);
        CHECK(std::isnan(parallel_max(10, threads, [&](int i) { return i == special ? nan : 0.1 * i; })));
      }
      CHECK(parallel_max(0, threads, [](int) { return 1.0; }) == 0);
    }
  }

  TEST_CASE("growth: a list whose size is predicted from its first rows is not copied again") {
    std::vector<int> list;
    constexpr std::size_t rows = 6400, of_each = 10;
    const int* place = nullptr;
    for (std::size_t done = 0; done < rows; ++done) {
      make_room(list, of_each, done, rows);
      CHECK(list.capacity() >= list.size() + of_each);
      if (done > 1000 && place != nullptr) CHECK(list.data() == place);
      list.resize(list.size() + of_each);
      place = list.data();
    }
    CHECK(list.capacity() < 1.2 * rows * of_each);
  }

  TEST_CASE("growth: a list that exceeds its predicted size still grows geometrically") {
    std::vector<int> list;
    int copies = 0;
    for (std::size_t done = 0; done < 1000; ++done) {
      const std::size_t before = list.capacity();
      make_room(list, done, done, 1000);
      copies += list.capacity() != before;
      list.resize(list.size() + done);
    }
    CHECK(copies < 60);
  }

  TEST_CASE(
      "team: one thread makes the first block of steps, and all threads make the next blocks if they are not slower") {
    for (const int most : {1, 3}) {
      TeamSize team(most);
      for (int step = 0; step < 1600; ++step) {
        CAPTURE(step);
        CHECK(team.threads() == (step < 16 ? 1 : most));
        team.step_took(step < 16 ? 1e-3 : 0.99e-3);
      }
    }
  }

  TEST_CASE(
      "team: a trial of all threads ends once the trial is slower than one thread, and costs 2 % of the time") {
    TeamSize team(2);
    CHECK(steps_alone(team) == 16);
    team.step_took(10e-3);
    CHECK(team.threads() == 2);
    team.step_took(10e-3);
    CHECK(team.threads() == 1);
    const int steps = steps_alone(team);
    CHECK(steps >= 50 * 18 - 16);
    CHECK(steps <= 50 * 18 + 16);
  }

  TEST_CASE("team: a team that never helps is tried ever less often") {
    TeamSize team(2);
    int before = steps_alone(team);
    for (int trial = 0; trial < 5; ++trial) {
      for (int k = 0; k < 16; ++k) team.step_took(1.001e-3);
      const int steps = steps_alone(team);
      CHECK(steps == 2 * before);
      before = steps;
    }
  }

  TEST_CASE("team: one thread is timed again after a hundred blocks, and blocks of long steps are short") {
    for (const double step : {1e-3, 1.0}) {
      const int block = step < 0.1 / 4 ? 16 : 4;
      TeamSize team(2);
      for (int k = 0; k < block; ++k) team.step_took(step);
      for (int k = 0; k < 100 * block; ++k) {
        CHECK(team.threads() == 2);
        team.step_took(0.6 * step);
      }
      CHECK(team.threads() == 1);
    }
  }
}

}  // namespace of_this_file
