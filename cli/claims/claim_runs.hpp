#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/claims/claim_file.hpp"
#include "cli/sweep/plan.hpp"

namespace taut::cli {

/// A claim with its validated runs.
struct PlannedClaim {
  const Claim* claim;
  SweepPlan plan;  // a run for each run of the claim, in its order
};

/// Checks the settings of all runs. Equal runs of several claims share a folder below `folder`. The claims must outlive
/// the plan. Throws SceneError with the place in the claim file, and UsageError.
std::vector<PlannedClaim> plan_claims(const std::vector<const Claim*>& claims,
                                      const std::filesystem::path& folder);

/// Unfinished runs, each folder once.
std::vector<SweepRun*> unfinished_runs(std::vector<PlannedClaim>& claims);

/// Result of a claim's runs.
struct ClaimOutcome {
  const Claim* claim;
  std::vector<std::pair<std::string, std::string>> values{};  // of its quantities: "og.verdict", "fractured"
  std::optional<ClaimState> state{};                          // as the runs show it; none: a problem
  bool evidence = true;   // the evidence of the reason is true, or there is none
  std::string problem{};  // a broken run, or a quantity without value

  bool agrees() const { return state == claim->state && evidence; }
};

/// Reads the run folders.
ClaimOutcome outcome_of(const PlannedClaim& planned);

}  // namespace taut::cli
