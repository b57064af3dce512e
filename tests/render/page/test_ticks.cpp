#include <string>

#include <doctest/doctest.h>

#include "render/page/ticks.hpp"
#include "tests/support/relative.hpp"

using namespace taut;
using namespace taut::test;
using namespace taut::render;

namespace {

std::string labels(const Ticks& ticks) {
  std::string all;
  for (const Tick& tick : ticks.at) all += tick.label + " ";
  return all + ticks.unit;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("tick labels have the decimals that tell them apart, and a common unit") {
    CHECK(labels(nice_ticks(0, 2e6, "Pa", 5)) == "0.0 0.5 1.0 1.5 2.0 MPa");
    CHECK(labels(nice_ticks(0, 1.93e6, "Pa", 5)) == "0.0 0.5 1.0 1.5 MPa");
    CHECK(labels(nice_ticks(-0.05, 0.05, "m", 5)) == "−40 −20 0 20 40 mm");
    CHECK(labels(nice_ticks(1199, 1201, "kg/m³", 5)) == "1199.0 1199.5 1200.0 1200.5 1201.0 kg/m³");
    CHECK(labels(nice_ticks(0, 1, "", 6)) == "0.0 0.2 0.4 0.6 0.8 1.0 ");
    CHECK(labels(nice_ticks(0, 2e-5, "", 4)) == "0 10 20 10⁻⁶");
    CHECK(labels(nice_ticks(0, 3e5, "1/s", 4)) == "0 100 200 300 10³ 1/s");
    CHECK(labels(nice_ticks(-2e9, -1e9, "Pa", 3)) == "−2.0 −1.5 −1.0 GPa");
  }

  TEST_CASE("ticks lie evenly in the range and do not exceed the requested number") {
    for (const double low : {-7.3e-4, -1.0, 0.0, 3.0, 99.7}) {
      for (const double length : {1e-3, 0.37, 1.0, 42.0, 1e5}) {
        for (const int most : {2, 3, 5, 8, 12}) {
          CAPTURE(low);
          CAPTURE(length);
          CAPTURE(most);
          const Ticks ticks = nice_ticks(low, low + length, "Pa", most);
          REQUIRE(ticks.at.size() >= 1);
          CHECK(static_cast<int>(ticks.at.size()) <= most);
          if (most >= 5) CHECK(ticks.at.size() >= 2);
          CHECK(ticks.at.front().value >= low - 1e-6 * length);
          CHECK(ticks.at.back().value <= low + length + 1e-6 * length);
          for (std::size_t i = 2; i < ticks.at.size(); ++i) {
            const double step = ticks.at[1].value - ticks.at[0].value;
            CHECK(ticks.at[i].value - ticks.at[i - 1].value == Approx(step));
            CHECK(ticks.at[i].label != ticks.at[i - 1].label);
          }
        }
      }
    }
  }

  TEST_CASE(
      "a number format sets decimals or powers of ten, and wider steps or more decimals avoid rounded labels") {
    const NumberFormat none{0}, two{2}, power{1, true};
    CHECK(labels(nice_ticks(0, 2e6, "Pa", 5, two)) == "0.00 0.50 1.00 1.50 2.00 MPa");
    CHECK(labels(nice_ticks(0, 2e6, "Pa", 5, power)) == "0 5.0×10⁵ 1.0×10⁶ 1.5×10⁶ 2.0×10⁶ Pa");
    CHECK(labels(nice_ticks(-2e-3, 0, "m", 3, power)) == "−2.0×10⁻³ −1.0×10⁻³ 0 m");
    CHECK(labels(nice_ticks(0, 2e6, "Pa", 5, none)) == "0 1 2 MPa");
    CHECK(labels(nice_ticks(0, 0.6, "", 5, none)) == "0.0 0.2 0.4 0.6 ");
    CHECK(labels(nice_ticks(1.15e6, 1.4e6, "Pa", 5, NumberFormat{0, true})) == "1.2×10⁶ 1.3×10⁶ 1.4×10⁶ Pa");
  }

  TEST_CASE("a range without extent or with an infinite end has no ticks") {
    CHECK(nice_ticks(1, 1, "Pa", 5).at.empty());
    CHECK(nice_ticks(0, 1.0 / 0.0, "Pa", 5).at.empty());
  }

  TEST_CASE("a unit gets an SI prefix or, if it takes none, a power of ten for small or large values") {
    CHECK(scale_for(2e6, "Pa").unit == "MPa");
    CHECK(scale_for(1000, "m").unit == "km");
    CHECK(scale_for(999.99, "m").unit == "m");
    CHECK(scale_for(-0.06, "m/s").unit == "mm/s");
    CHECK(scale_for(3e-7, "s").unit == "ns");
    CHECK(scale_for(3e5, "s").unit == "s");
    CHECK(scale_for(1e-30, "m").unit == "fm");
    CHECK(scale_for(0, "m").unit == "m");
    // a prefix would be squared, and kg already has one
    CHECK(scale_for(1e-6, "m²").unit == "10⁻⁶ m²");
    CHECK(scale_for(12000, "kg/m³").unit == "10³ kg/m³");
    CHECK(scale_for(0.5, "rad").unit == "rad");
  }

  TEST_CASE("numbers are formatted with fixed decimals, and times with their unit") {
    CHECK(format_fixed(-0.0004, 2) == "0.00");
    CHECK(format_fixed(-1.25, 1) == "−1.2");
    CHECK(format_time(0.005004) == "t = 5.004 ms");
    CHECK(format_time(0) == "t = 0.000 s");
    CHECK(format_time(0, 0.012) == "t = 0.000 ms");
    CHECK(format_time(0.0005, 0.012) == "t = 0.500 ms");
    CHECK(format_time(1.5, 2) == "t = 1.500 s");
  }

  TEST_CASE("the length of a scale bar is 1, 2 or 5 times a power of ten and does not exceed its limit") {
    CHECK(nice_length(0.037) == Approx(0.02));
    CHECK(nice_length(0.05) == Approx(0.05));
    CHECK(nice_length(0.1) == Approx(0.1));
    CHECK(nice_length(9.99) == Approx(5));
  }
}
