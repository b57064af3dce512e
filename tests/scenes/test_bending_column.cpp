#include <doctest/doctest.h>

#include "tests/support/program_runner.hpp"

namespace of_this_file {

using namespace taut::cli;
using namespace taut::test;

namespace {

/// Greatest pressure checkerboard at ν = 0.499.
double pressure_checkerboard(const TemporaryFolder& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{
      "run", "bending-column", "--set", "poisson_ratio=0.499", "--until", "0.6", "--out", folder.str("out")};
  arguments.insert(arguments.end(), {"--no-render", "--quiet", "--threads", "1"});
  arguments.insert(arguments.end(), more.begin(), more.end());
  REQUIRE(call(arguments).code == 0);
  const auto record = json_of(folder / "out/run.json");
  CHECK(record["verdict"] == "stable");
  return record["indicators"]["pressure_checkerboard"]["greatest"];
}

}  // namespace

TEST_SUITE("failure") {
  TEST_CASE("bending column: at ν = 0.499 pf-jst has over three times the pressure checkerboard of pfj-jst") {
    const TemporaryFolder folder;
    for (const std::string spacing : {"0.3333", "0.2"}) {  // [Lee2016] Fig. 23, and finer
      CAPTURE(spacing);
      const double smooth = pressure_checkerboard(folder, {"--spacing", spacing});
      CHECK(smooth > 1e-4);
      CHECK(pressure_checkerboard(folder, {"--spacing", spacing, "--method", "pf-jst"}) > 3 * smooth);
    }
  }
}

}  // namespace of_this_file
