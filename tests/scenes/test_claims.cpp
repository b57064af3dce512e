#include <doctest/doctest.h>

#include "cli/claims/claim_file.hpp"
#include "cli/claims/claim_runs.hpp"
#include "cli/scene/shipped.hpp"
#include "tests/support/program_runner.hpp"

namespace of_this_file {

using namespace taut::cli;
using namespace taut::test;

namespace {

void check_quick_claims(const std::string& paper) {
  const TemporaryFolder folder;
  const Outcome outcome =
      call({"claims", paper, "--quick", "--jobs", "1", "--quiet", "--out", (folder / "runs").string()});
  CHECK_MESSAGE(outcome.code == 0, outcome.out << outcome.err);
}

}  // namespace

TEST_SUITE("failure") {
  // the other papers' claims take minutes; see test_statements.cpp
  TEST_CASE("the quick claims of Lee2016 have their recorded state") { check_quick_claims("Lee2016"); }
  TEST_CASE("the quick claims of Zhang2020 have their recorded state") { check_quick_claims("Zhang2020"); }
  TEST_CASE("the quick claims of Wu2023 have their recorded state") { check_quick_claims("Wu2023"); }

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
        if (!claim.quick && ++slow > 0) {
          CAPTURE(claim.name());
          CHECK_NOTHROW(plan_claims({&claim}, folder / claim.key));
        }
    CHECK(slow > 10);
  }
}

}  // namespace of_this_file
