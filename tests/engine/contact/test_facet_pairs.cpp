#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/contact/facet_pairs.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/layout/surface_mesh.hpp"
#include "tests/support/pressed.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

using V = Vec<double, 3>;
using Pairs = std::vector<std::pair<int, int>>;

constexpr double dp = 0.001;
constexpr FacetPairs::Limits limits{.listed = 3 * dp, .horizon = 4 * dp, .far = 4 * dp, .cosine = 0.5};
constexpr auto all = [](int, int) { return true; };

/// A bent strip whose ends nearly meet, and a ball.
struct Bent {
  MovingFacets facets;
  FacetPairs near;

  Bent() {
    constexpr double length = 48 * dp, gap = 1.5 * dp,
                     around = 2 * std::numbers::pi * length / (length + gap);
    const Scene scene =
        scene_of_shapes({Box{{0, 0, 0}, {length, 5 * dp, 5 * dp}}, Disc{{100 * dp, 0, 0}, 3 * dp}}, 3, dp);
    const InitialParticles initial = make_initial_particles(scene);
    facets = MovingFacets(make_surface_mesh(scene, initial));
    near = FacetPairs(facets, 4 * dp);
    Particles<3> s;
    for (int i = 0; i < initial.size(); ++i) {
      const Point& X = initial.x[i];
      const double turn = around * X[0] / length, r = (length + gap) / (2 * std::numbers::pi) + X[1];
      const double out = X[2] + 0.2 * r * std::sin(turn);
      s.x.push_back(initial.body[i] == 0 ? V{r * std::cos(turn), r * std::sin(turn), out}
                                         : V{X[0] - 117 * dp, X[1] + 0.4 * dp, X[2] + 1.7 * dp});
      s.m.push_back(1);
      s.id.push_back(i);
    }
    facets.renumber(s);
    facets.place(s, facets.nodes_of(near.order()), near.order(), 1);
  }

  template <PairsOf kind, class Wanted>
  double find(const std::vector<int>& candidates, const Wanted& wanted, Pairs& found) const {
    double beyond = limits.horizon;
    for (std::size_t p = 0; p < candidates.size(); ++p) {
      for (std::size_t q = 0; q < p; ++q) {
        const int f = std::min(candidates[p], candidates[q]), g = std::max(candidates[p], candidates[q]);
        if ((kind == PairsOf::one_body) != (facets.body(f) == facets.body(g))) continue;
        const V D = near.start(f) - near.start(g), d = facets[f].middle - facets[g].middle;
        if (kind == PairsOf::one_body && dot(D, D) <= limits.far * limits.far) continue;
        if (dot(facets[f].normal, facets[g].normal) >= limits.cosine || !wanted(f, g)) continue;
        const double distance = std::sqrt(dot(d, d));
        if (distance < limits.listed)
          found.emplace_back(f, g);
        else
          beyond = std::min(beyond, distance);
      }
    }
    std::ranges::sort(found);
    return beyond;
  }

  template <PairsOf kind, class Wanted = decltype(all)>
  void check(const std::vector<int>& candidates, const Wanted& wanted = all) {
    Pairs expected, found;
    const double beyond = find<kind>(candidates, wanted, expected);
    REQUIRE(expected.size() > 20);
    REQUIRE(beyond < limits.horizon);
    CHECK(near.find<kind>(facets, candidates, limits, wanted, [&](int f, int g) {
      found.emplace_back(std::min(f, g), std::max(f, g));
    }) == beyond);
    std::ranges::sort(found);
    CHECK(found == expected);
  }
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("facet pairs: the search by clusters finds the same pairs as brute force") {
    Bent bent;
    std::vector<int> order = bent.near.order();
    SUBCASE("within one body") { bent.check<PairsOf::one_body>(order); }
    SUBCASE("between two bodies") { bent.check<PairsOf::two_bodies>(order); }
    SUBCASE("for a part of the facets") {
      std::erase_if(order, [](int f) { return f % 3 == 1; });
      bent.check<PairsOf::one_body>(order);
      bent.check<PairsOf::two_bodies>(order);
    }
    SUBCASE("for wanted pairs only") {
      const auto wanted = [](int f, int g) { return (f + g) % 2 == 0; };
      bent.check<PairsOf::one_body>(order, wanted);
      bent.check<PairsOf::two_bodies>(order, wanted);
    }
    SUBCASE("the order contains each facet once") {
      std::ranges::sort(order);
      std::vector<int> facets(bent.near.size());
      std::iota(facets.begin(), facets.end(), 0);
      CHECK(order == facets);
    }
  }
}

}  // namespace of_this_file
