#include <algorithm>
#include <regex>

#include <doctest/doctest.h>

#include "cli/claims/claim_file.hpp"
#include "cli/claims/claim_runs.hpp"
#include "cli/scene/shipped.hpp"
#include "tests/support/program_runner.hpp"

namespace of_this_file {

using namespace taut::cli;
using namespace taut::test;

namespace {

/// Runs claims about all scenes if `scenes` is empty.
void check_quick_claims(const std::string& paper, const std::vector<std::string>& scenes = {}) {
  const TemporaryFolder folder;
  std::vector<std::string> command{"claims", "--run"};
  for (const Paper& each : shipped_papers())
    for (const Claim& claim : each.claims)
      if (each.key == paper && claim.quick &&
          (scenes.empty() || std::ranges::count(scenes, fs::path(claim.scene).stem().string()) > 0))
        command.push_back(claim.name());
  REQUIRE(command.size() > 2);
  command.insert(command.end(), {"--jobs", "1", "--quiet", "--out", folder.str("runs")});
  const Outcome outcome = call(command);
  CHECK_MESSAGE(outcome.code == 0, outcome.out << outcome.err);
}

}  // namespace

TEST_SUITE("failure") {
  // test cases run in parallel, so the claims are distributed over several
  TEST_CASE("the quick claims of Zhang2024 about plates have their recorded state") {
    check_quick_claims("Zhang2024", {"oscillating-plate", "oscillating-plate-3d"});
  }
  TEST_CASE("the quick claims of Zhang2024 about collisions have their recorded state") {
    check_quick_claims("Zhang2024", {"colliding-rings", "colliding-balls"});
  }
  TEST_CASE("the quick claims of Zhang2024 about a ball on a plate have their recorded state") {
    check_quick_claims("Zhang2024", {"ball-plate", "ball-plate-3d"});
  }
  TEST_CASE("the quick claims of Khayyer2024 about plates have their recorded state") {
    check_quick_claims("Khayyer2024", {"oscillating-plate", "rotating-plate"});
  }
  TEST_CASE("the quick claims of Khayyer2024 about cables have their recorded state") {
    check_quick_claims("Khayyer2024", {"elastic-cable", "elastic-cable-velocity", "heterogeneous-cable"});
  }
  TEST_CASE("the quick claims of Lee2016 have their recorded state") { check_quick_claims("Lee2016"); }
  TEST_CASE("the quick claims of TranDuc2023 have their recorded state") {
    check_quick_claims("TranDuc2023");
  }
  TEST_CASE("the quick claims of Zhang2020 have their recorded state") { check_quick_claims("Zhang2020"); }
  TEST_CASE("the quick claims of Ganzenmueller2015 and Wu2023 have their recorded state") {
    check_quick_claims("Ganzenmueller2015");
    check_quick_claims("Wu2023");
  }

  TEST_CASE("each quick claim is run by a test case above") {
    const std::string cases =
        text_of(std::filesystem::path(TAUT_SOURCE_DIR) / "tests/scenes/test_claims.cpp");
    for (const Paper& paper : shipped_papers())
      for (const Claim& claim : paper.claims) {
        if (!claim.quick) continue;
        CAPTURE(claim.name());
        const std::string scene = fs::path(claim.scene).stem().string();
        const std::regex listed("check_quick_claims\\(\"" + paper.key + "\"(\\)|[^;]*\"" + scene + "\")");
        CHECK(std::regex_search(cases, listed));
      }
  }

  TEST_CASE("the table of the claims agrees with the claim files") {
    const std::string page =
        text_of(std::filesystem::path(TAUT_SOURCE_DIR) / "scenes/studies/results/claims.md");
    const Outcome tables = call({"claims", "--markdown"});
    CHECK(tables.code == 0);
    CHECK_MESSAGE(page.ends_with("\n\n" + tables.out),
                  "scenes/studies/results/claims.md is out of date; run scenes/studies/update-claims.sh");
  }

  TEST_CASE("the scenes and settings of the slow claims are valid") {
    const TemporaryFolder folder;
    int slow = 0;
    for (const Paper& paper : shipped_papers())
      for (const Claim& claim : paper.claims)
        if (!claim.quick) {
          ++slow;
          CAPTURE(claim.name());
          CHECK_NOTHROW(plan_claims({&claim}, folder / claim.key));
        }
    CHECK(slow > 10);
  }
}

}  // namespace of_this_file
