
#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "engine/methods/ul_split/methods.hpp"
#include "engine/methods/ul_split/passes.hpp"

namespace of_this_file {

using namespace taut;

namespace {

UlSplitConstants constants_at(double dp) {
  UlSplitConstants c{};
  c.dp = dp;
  c.h = 1.3 * dp;
  c.exponent = 4;
  return c;
}

template <int Dim>
struct Cached {
  PairGeometry<Dim> exact, cached, back;
};
template <int Dim>
Cached<Dim> cached_at(double dp, const Pack& distance) {
  const UlSplitConstants c = constants_at(dp);
  const PairKernel<enog.kernel, Dim> kernel(c);
  using Stored = typename PairCache<Dim>::Stored;
  std::vector<Stored> gradients(2 * Dim), slopes(2), distances(2);
  const bool single_precision = PairCache<Dim>::single_precision;
  const PairCache<Dim> pairs{gradients.data(),
                             slopes.data(),
                             distances.data(),
                             nullptr,
                             single_precision ? PairKernel<enog.kernel, Dim>::steepness(c) : 1,
                             single_precision ? c.h : 1};
  Vec<Pack, Dim> d{}, back{};
  d[0] = 0.6 * dp * distance, d[1] = -0.8 * dp * distance;
  for (int k = 0; k < Dim; ++k) back[k] = -d[k];
  pairs.set(0, kernel.geometry(d));
  pairs.set(1, kernel.geometry(back));
  return {kernel.geometry(d), pairs[0], pairs[1]};
}

constexpr double edge = 2.6;
const Pack usual{0.3, 0.99, 1.7, 2.4};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("cached pairs: values are exact in 2D and have single precision in 3D") {
    const Cached<2> flat = cached_at<2>(0.001, usual);
    const Cached<3> solid = cached_at<3>(0.001, usual);
    for (int lane = 0; lane < lanes; ++lane) {
      for (int k = 0; k < 2; ++k) {
        CHECK(flat.cached.gradient[k][lane] == flat.exact.gradient[k][lane]);
        const double exact = solid.exact.gradient[k][lane];
        CHECK(std::abs(solid.cached.gradient[k][lane] - exact) < 1e-7 * std::abs(exact));
        CHECK(solid.cached.gradient[k][lane] != exact);
      }
      CHECK(flat.cached.inverse_slope[lane] == flat.exact.inverse_slope[lane]);
      CHECK(flat.cached.inverse_distance[lane] == flat.exact.inverse_distance[lane]);
      CHECK(std::abs(solid.cached.inverse_slope[lane] / solid.exact.inverse_slope[lane] - 1) < 1e-7);
      CHECK(std::abs(solid.cached.inverse_distance[lane] / solid.exact.inverse_distance[lane] - 1) < 1e-7);
    }
  }

  TEST_CASE("cached pairs: both directions have opposite gradients to the last bit and equal values") {
    const Cached<3> pair = cached_at<3>(0.0017, usual);
    for (int lane = 0; lane < lanes; ++lane) {
      for (int k = 0; k < 3; ++k) CHECK(pair.cached.gradient[k][lane] == -pair.back.gradient[k][lane]);
      CHECK(pair.cached.inverse_slope[lane] == pair.back.inverse_slope[lane]);
      CHECK(pair.cached.inverse_distance[lane] == pair.back.inverse_distance[lane]);
    }
  }

  TEST_CASE(
      "cached pairs: values are finite at any spacing, at the kernel's edge and for coincident particles") {
    constexpr double ulp = std::numeric_limits<double>::epsilon();
    for (const double dp : {1e-30, 1e-9, 1e-3, 1.0, 1e9, 1e30}) {
      CAPTURE(dp);
      for (const double r : {0.0, 1e-300, 1e-20, 1e-12, 1e-6, 1.0, edge * (1 - 1e-6), edge * (1 - 1e-11),
                             edge * (1 - 2 * ulp), edge, edge * (1 + 2 * ulp), 3.0}) {
        CAPTURE(r);
        const PairGeometry<3> cached = cached_at<3>(dp, Pack{r, r, r, r}).cached;
        const double slope = std::hypot(cached.gradient[0][0], cached.gradient[1][0]);
        CHECK(std::isfinite(slope));
        const double unity = -cached.inverse_slope[0] * slope;
        CHECK((unity == 0 ? cached.inverse_distance[0] == 0 : std::abs(unity - 1) < 1e-6));
        const double inverse = cached.inverse_distance[0] * slope * r * dp;
        CHECK((unity == 0 ? slope == 0 : std::abs(inverse + 1) < 1e-6));
        CHECK((unity != 0) == (r > 1e-14 && r < edge * (1 - 1e-10)));
      }
    }
  }
}

}  // namespace of_this_file
