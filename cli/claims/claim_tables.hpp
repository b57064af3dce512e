#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/claims/claim_runs.hpp"
#include "cli/text/json.hpp"
#include "cli/text/test_report.hpp"

namespace taut::cli {

/// Claims with statement and state. `columns`: width of the text.
std::string list_of_claims(const std::vector<const Claim*>& claims, std::optional<std::size_t> columns);
/// All about one claim, with the commands that repeat its runs.
std::string claim_text(const Claim& claim, std::size_t columns);
/// Recorded and found states with the values of the quantities.
std::string table_of_outcomes(const std::vector<ClaimOutcome>& outcomes, std::optional<std::size_t> columns);
/// Number of claims by paper and state; claims that do not hold with their reasons; all claims.
std::string claims_markdown(const std::vector<Paper>& papers);

/// `outcome`: of the runs, or nullptr.
Json claim_json(const Claim& claim, const ClaimOutcome* outcome);
TestReport claims_report(const std::vector<ClaimOutcome>& outcomes);

/// "taut run oscillating-plate --method og --until 0.05".
std::string command_of(const Claim& claim, const ClaimRun& run);

}  // namespace taut::cli
