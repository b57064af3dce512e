// The geometry of pairs as the methods of [Zhang2024] hold it between rebuilds.

#include <cmath>
#include <initializer_list>
#include <limits>

#include <doctest/doctest.h>

#include "engine/families/ul_split/passes.hpp"
#include "engine/methods/zhang2024.hpp"

namespace of_this_file {

using namespace taut;

namespace {

Constants constants_at(double dp) {
  Constants c{};
  c.dp = dp;
  c.h = 1.3 * dp;
  c.exponent = 4;
  return c;
}

/// Four pairs at these distances, in spacings, as they are worked out and as they are held.
template <int Dim>
struct Held {
  PairGeometry<Dim> exact, held, back;  // back: of j, i
};
template <int Dim>
Held<Dim> held_at(double dp, const Pack& distance) {
  const Constants c = constants_at(dp);
  const PairKernel<enog, Dim> kernel(c);
  HeldPairs<Dim> pairs;
  pairs.make_room(2, false, PairKernel<enog, Dim>::steepness(c), c.h);
  Vec<Pack, Dim> d{}, back{};
  d[0] = 0.6 * dp * distance, d[1] = -0.8 * dp * distance;
  for (int k = 0; k < Dim; ++k) back[k] = -d[k];
  pairs.set(0, kernel.geometry(d));
  pairs.set(1, kernel.geometry(back));
  return {kernel.geometry(d), pairs[0], pairs[1]};
}

constexpr double edge = 2.6;  // of the kernel, spacings
const Pack usual{0.3, 0.99, 1.7, 2.4};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("held pairs: in 2D as they were worked out, in 3D to single precision") {
    const Held<2> flat = held_at<2>(0.001, usual);
    const Held<3> solid = held_at<3>(0.001, usual);
    for (int lane = 0; lane < lanes; ++lane) {
      for (int k = 0; k < 2; ++k) {
        CHECK(flat.held.gradient[k][lane] == flat.exact.gradient[k][lane]);
        const double exact = solid.exact.gradient[k][lane];
        CHECK(std::abs(solid.held.gradient[k][lane] - exact) < 1e-7 * std::abs(exact));
        CHECK(solid.held.gradient[k][lane] != exact);
      }
      CHECK(flat.held.inverse_slope[lane] == flat.exact.inverse_slope[lane]);
      CHECK(flat.held.inverse_distance[lane] == flat.exact.inverse_distance[lane]);
      CHECK(std::abs(solid.held.inverse_slope[lane] / solid.exact.inverse_slope[lane] - 1) < 1e-7);
      CHECK(std::abs(solid.held.inverse_distance[lane] / solid.exact.inverse_distance[lane] - 1) < 1e-7);
    }
  }

  TEST_CASE("held pairs: gradients are opposite to the last bit, the rest is the same") {
    const Held<3> pair = held_at<3>(0.0017, usual);
    for (int lane = 0; lane < lanes; ++lane) {
      for (int k = 0; k < 3; ++k) CHECK(pair.held.gradient[k][lane] == -pair.back.gradient[k][lane]);
      CHECK(pair.held.inverse_slope[lane] == pair.back.inverse_slope[lane]);
      CHECK(pair.held.inverse_distance[lane] == pair.back.inverse_distance[lane]);
    }
  }

  TEST_CASE("held pairs: whatever the spacing is to a metre, at the edge of the kernel and in one place") {
    constexpr double ulp = std::numeric_limits<double>::epsilon();
    for (const double dp : {1e-30, 1e-9, 1e-3, 1.0, 1e9, 1e30}) {
      CAPTURE(dp);
      for (const double r : {0.0, 1e-300, 1e-20, 1e-12, 1e-6, 1.0, edge * (1 - 1e-6), edge * (1 - 1e-11),
                             edge * (1 - 2 * ulp), edge, edge * (1 + 2 * ulp), 3.0}) {
        CAPTURE(r);
        const PairGeometry<3> held = held_at<3>(dp, Pack{r, r, r, r}).held;
        const double slope = std::hypot(held.gradient[0][0], held.gradient[1][0]);
        CHECK(std::isfinite(slope));
        // of the product that stands for one, what is left of single precision; of none, all are 0
        const double unity = -held.inverse_slope[0] * slope;
        CHECK((unity == 0 ? held.inverse_distance[0] == 0 : std::abs(unity - 1) < 1e-6));
        const double inverse = held.inverse_distance[0] * slope * r * dp;
        CHECK((unity == 0 ? slope == 0 : std::abs(inverse + 1) < 1e-6));
        CHECK((unity != 0) == (r > 1e-14 && r < edge * (1 - 1e-10)));
      }
    }
  }
}

}  // namespace of_this_file
