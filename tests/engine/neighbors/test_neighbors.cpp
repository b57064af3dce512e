#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <sys/resource.h>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/neighbors/close_pairs.hpp"
#include "engine/neighbors/lane_neighbors.hpp"
#include "engine/neighbors/neighbors.hpp"
#include "tests/support/made_snapshot.hpp"

namespace of_this_file {

using namespace taut;

namespace {

template <int Dim>
using Points = std::vector<Vec<double, Dim>>;

constexpr double support = 0.13;

template <int Dim>
Points<Dim> random_points(int n, double side, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> place(-0.3 * side, 0.7 * side);
  Points<Dim> x(n);
  for (auto& p : x)
    for (int k = 0; k < Dim; ++k) p[k] = place(generator);
  return x;
}

template <int Dim>
struct Found {
  Points<Dim> x;
  std::vector<int> order;
  Neighbors neighbors;

  explicit Found(const Points<Dim>& points, int threads = 1, double reach = support) {
    CellGrid<Dim> grid;
    order = grid.sort(points, reach);
    for (const int i : order) x.push_back(points[i]);
    NeighborSearch<Dim>()(grid, x, reach, threads, neighbors);
  }
  std::vector<int> of(int i) const {
    std::vector<int> list(neighbors.j.begin() + lanes * neighbors.begin[i],
                          neighbors.j.begin() + lanes * neighbors.begin[i + 1]);
    std::erase(list, i);  // padding
    std::ranges::sort(list);
    return list;
  }
};

template <int Dim>
std::vector<int> brute_force(const Points<Dim>& x, int i, double reach) {
  std::vector<int> list;
  for (int j = 0; j < static_cast<int>(x.size()); ++j) {
    const Vec<double, Dim> d = x[i] - x[j];
    if (j != i && dot(d, d) < reach * reach) list.push_back(j);
  }
  return list;
}

/// In KiB.
long peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

/// Returns the number of directed pairs.
template <int Dim>
long check_against_brute_force(const Points<Dim>& points, double reach = support) {
  const Found<Dim> found(points, 1, reach);
  std::vector<int> ascending = found.order;
  std::ranges::sort(ascending);
  std::vector<int> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  CHECK(ascending == all);
  long pairs = 0, wrong = 0;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const std::vector<int> expected = brute_force(found.x, i, reach);
    wrong += found.of(i) != expected;
    pairs += static_cast<long>(expected.size());
  }
  CHECK(wrong == 0);
  CHECK(found.neighbors.pairs == pairs);
  return pairs;
}

}  // namespace

TEST_SUITE("neighbors") {
  TEST_CASE("neighbors: sparse and dense random points have the lists of brute force") {
    for (const unsigned seed : {1u, 2u, 3u}) {
      for (const double side : {0.2, 1.0, 10.0}) {
        CAPTURE(seed);
        CAPTURE(side);
        CHECK(check_against_brute_force(random_points<2>(600, side, seed)) > 0);
        CHECK(check_against_brute_force(random_points<3>(600, side / 2, seed)) > 0);
      }
    }
  }

  TEST_CASE("neighbors: few points have the lists of brute force") {
    for (const int n : {1, 2, 3, 4, 5}) check_against_brute_force(random_points<2>(n, support, 7));
  }

  TEST_CASE("neighbors: collinear points along axes and an oblique line have the lists of brute force") {
    for (const Vec<double, 2> direction : {Vec<double, 2>{1, 0}, {0, 1}, {-0.6, 0.8}}) {
      Points<2> x;
      for (int k = 0; k < 200; ++k) x.push_back((0.3 * support * k) * direction);
      CHECK(check_against_brute_force(x) > 200 * 5);
    }
  }

  TEST_CASE("neighbors: a lattice with rows on cell borders has the lists of brute force") {
    Points<2> x;
    for (int i = 0; i < 20; ++i)
      for (int j = 0; j < 20; ++j) x.push_back({0.5 * support * i, 0.5 * support * j});
    CHECK(check_against_brute_force(x) > 400 * 4);
  }

  TEST_CASE("neighbors: points all in one place are neighbours of each other") {
    const Points<2> x(50, {0.3, -4});
    CHECK(check_against_brute_force(x) == 50 * 49);
  }

  TEST_CASE("neighbors: distant outliers do not remove pairs or need memory for the space between") {
    const long before = peak_memory();
    for (const double far : {1e3, 1e7, 1e300}) {
      CAPTURE(far);
      Points<2> x = random_points<2>(300, 1, 11);
      const long pairs = check_against_brute_force(x);
      x.push_back({far, 0});
      x.push_back({0, -far});
      x.push_back({far, far});
      CHECK(pairs > 300);
      CHECK(check_against_brute_force(x) == pairs);
    }
    CHECK(peak_memory() - before < 32 * 1024);
  }

  TEST_CASE("neighbors: a position that is not finite, or too far for any cell, is refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    for (const double place : {nan, inf, -inf, 1e308}) {
      for (const std::size_t at : {std::size_t{0}, std::size_t{7}}) {
        CAPTURE(place);
        CAPTURE(at);
        Points<2> x = random_points<2>(20, 1, 11);
        x[at][1] = place;
        CellGrid<2> grid;
        CHECK_THROWS_AS(grid.sort(x, support), taut::NumericalError);
      }
    }
    for (const double reach : {nan, inf}) {
      CAPTURE(reach);
      CellGrid<2> grid;
      CHECK_THROWS_AS(grid.sort(random_points<2>(20, 1, 11), reach), taut::NumericalError);
    }
    const Points<2> all_far(20, {1e30, -1e30});  // too far for coordinates to resolve a cell
    CellGrid<2> grid;
    CHECK_THROWS_AS(grid.sort(all_far, support), taut::NumericalError);
  }

  TEST_CASE("neighbors: a point exactly at the support radius is no neighbour") {
    const double reach = 0.25;
    for (const double sign : {-1.0, 1.0}) {
      const Points<2> at = {{1, 1}, {1 + sign * reach, 1}, {1, 1 + sign * reach}};
      CHECK(check_against_brute_force(at, reach) == 0);
      Points<2> inside = at;
      inside[1][0] = std::nextafter(inside[1][0], 1.0);
      CHECK(check_against_brute_force(inside, reach) == 2);
    }
  }

  TEST_CASE("neighbors: the last pack is padded with the particle itself") {
    const Found<2> found(random_points<2>(300, 1, 5));
    int filled_up = 0;
    for (int i = 0; i < 300; ++i) {
      const int begin = lanes * found.neighbors.begin[i], end = lanes * found.neighbors.begin[i + 1];
      const int real = static_cast<int>(found.of(i).size());
      CHECK((end - begin) == (real + lanes - 1) / lanes * lanes);
      for (int k = begin; k < end; ++k) CHECK((found.neighbors.j[k] == i) == (k - begin >= real));
      filled_up += end - begin - real;
    }
    CHECK(filled_up > 0);
  }

  TEST_CASE("neighbors: the lists do not depend on the number of threads") {
    const Points<2> x = random_points<2>(1000, 1, 3);
    const Found<2> one(x);
    CHECK(one.neighbors.pairs > 1000);
    for (const int threads : {2, 3}) {
      const Found<2> several(x, threads);
      CHECK(several.neighbors.begin == one.neighbors.begin);
      CHECK(several.neighbors.j == one.neighbors.j);
      CHECK(several.neighbors.pairs == one.neighbors.pairs);
    }
  }

  TEST_CASE("neighbors: a search may be used again for more and for fewer points") {
    CellGrid<2> grid;
    NeighborSearch<2> search;
    Neighbors neighbors;
    for (const int n : {100, 900, 10}) {
      const Points<2> points = random_points<2>(n, 1, 17);
      Points<2> x;
      for (const int i : grid.sort(points, support)) x.push_back(points[i]);
      search(grid, x, support, 2, neighbors);
      const Found<2> fresh(points);
      CHECK(neighbors.begin == fresh.neighbors.begin);
      CHECK(neighbors.j == fresh.neighbors.j);
    }
  }

  TEST_CASE("grid: the order is stable") {
    const Points<2> once = random_points<2>(200, 1, 9);
    Points<2> thrice;
    for (int copy = 0; copy < 3; ++copy) thrice.insert(thrice.end(), once.begin(), once.end());
    const Found<2> found(thrice);
    std::vector<int> place(thrice.size());
    for (int k = 0; k < 600; ++k) place[found.order[k]] = k;
    for (int k = 0; k < 200; ++k) {
      CHECK(place[k] < place[k + 200]);
      CHECK(place[k + 200] < place[k + 400]);
    }
    CHECK_FALSE(std::ranges::is_sorted(found.order));
  }

  TEST_CASE("grid: sorting sorted points changes nothing") {
    const Found<2> found(random_points<2>(500, 1, 21));
    CHECK_FALSE(std::ranges::is_sorted(found.order));
    CHECK(std::ranges::is_sorted(Found<2>(found.x).order));
  }

  TEST_CASE("neighbors: slots of lanes gather each neighbour of each particle once, in order") {
    const int around = 30;
    Points<2> x;
    for (int k = 0; k < 2 * around; ++k) {
      const double angle = 2 * std::numbers::pi * (k % around) / around, r = k < around ? 0.5 : 0.6;
      x.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    for (const auto& p : random_points<2>(35, 0.7, 11)) x.push_back({p[0] + 10, p[1]});
    const int n = static_cast<int>(x.size());
    Columns<2> columns;
    columns.resize(n);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 2; ++k) columns[k][i] = x[i][k];
    int slots = 0, in_line = 0;
    for (int first = 0; first < n; first += lanes) {
      std::array<std::vector<int>, lanes> neighbors;
      for (int lane = 0; lane < lanes && first + lane < n; ++lane)
        neighbors[lane] = brute_force(x, first + lane, support);
      const LaneSlots found = lane_slots(first, neighbors, columns.size());
      REQUIRE(found.slots.size() == found.taken.size());
      int next[lanes] = {};
      for (std::size_t b = 0; b < found.slots.size(); ++b) {
        Pack place[2];
        gather(columns, first, found.slots[b], place);
        for (int lane = 0; lane < lanes; ++lane) {
          if (found.taken[b][lane] < 0) continue;
          CHECK(found.taken[b][lane] == next[lane]++);
          const int j = neighbors[lane][found.taken[b][lane]];
          CHECK(double{place[0][lane]} == x[j][0]);
          CHECK(double{place[1][lane]} == x[j][1]);
        }
        if (first + lanes <= 2 * around) ++slots, in_line += found.slots[b].in_line;
      }
      for (int lane = 0; lane < lanes; ++lane) CHECK(next[lane] == std::ssize(neighbors[lane]));
    }
    CHECK(in_line > 0.8 * slots);
  }

  TEST_CASE("close pairs: the pairs of brute force appear once, in the same order on 1, 2, 3 and 8 threads") {
    constexpr int n = 5000;
    constexpr double reach = 0.02;
    std::vector<Point> places;
    for (const auto& x : random_points<2>(n, 1, 3)) places.push_back({x[0], x[1], 0});
    const Snapshot start = test::made_snapshot(2, places);
    using Pairs = std::vector<std::pair<int, int>>;
    const auto pairs_on = [&](int threads) {
      Pairs pairs;
      const auto add = [&](int i, int j) { pairs.emplace_back(i, j); };
      for_each_close_pair(start, reach, add, threads);
      return pairs;
    };
    const Pairs alone = pairs_on(1);
    for (const int threads : {2, 3, 8}) CHECK((pairs_on(threads) == alone));
    Pairs sorted = alone, expected;
    std::ranges::sort(sorted);
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j) {
        const double x = places[i][0] - places[j][0], y = places[i][1] - places[j][1];
        if (x * x + y * y <= reach * reach) expected.emplace_back(i, j);
      }
    CHECK((sorted == expected));
  }
}

}  // namespace of_this_file
