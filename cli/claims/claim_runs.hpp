#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/claims/claim_file.hpp"
#include "cli/sweep/plan.hpp"

namespace taut::cli {

struct PlannedClaim {
  const Claim* claim;
  SweepPlan plan;  // in the order of the claim's runs
};

/// Equal runs share a folder below `folder`. The claims must outlive the plan. Throws SceneError and UsageError.
std::vector<PlannedClaim> plan_claims(const std::vector<const Claim*>& claims,
                                      const std::filesystem::path& folder);

/// Each folder once.
std::vector<SweepRun*> unfinished_runs(std::vector<PlannedClaim>& claims);

struct ClaimOutcome {
  const Claim* claim;
  std::vector<std::pair<std::string, std::string>> values{};  // "og.verdict", "fractured"
  std::optional<ClaimState> state{};                          // none if there is a `problem`
  bool evidence = true;                                       // condition is true or absent
  std::string problem{};                                      // reason for a missing `state`

  bool agrees() const { return state == claim->state && evidence; }
};

ClaimOutcome outcome_of(const PlannedClaim& planned);

}  // namespace taut::cli
