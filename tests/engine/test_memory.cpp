#include <malloc.h>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "engine/diagnostics/indicators.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

double in_use() {
  const auto now = mallinfo2();
  return static_cast<double>(now.uordblks) + static_cast<double>(now.hblkhd);
}

/// Per particle, including snapshot and indicators.
double kilobytes_each(const std::string& method) {
  const Scene scene = colliding_rings(/*v0*/ 0.06, /*dp*/ 0.0005);
  const double before = in_use();
  const auto simulation = make_simulation(scene, with_method(method));
  simulation->advance_to(2e-6);
  const Snapshot& now = simulation->snapshot();
  IndicatorGauge gauge(scene, now);
  gauge(now);
  return (in_use() - before) / 1e3 / static_cast<double>(now.size());
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("memory: six methods take less than their known size per particle in 2D") {
    if (in_use() == 0) {
      MESSAGE("skipped: the heap of a sanitizer reports no sizes");
      return;
    }
    const std::pair<std::string, double> known[] = {
        {"tl", 0.88},   {"pf-jst", 1.19},        {"oenog", 2.25},
        {"enog", 1.58}, {"d-ulsph-r-tic", 1.34}, {"ccb", 1.05},
    };
    for (const auto& [method, most] : known) {
      CAPTURE(method);
      CHECK(kilobytes_each(method) < most);
    }
  }
}

}  // namespace of_this_file
