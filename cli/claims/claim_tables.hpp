#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/claims/claim_runs.hpp"
#include "cli/text/json.hpp"
#include "cli/text/test_report.hpp"

namespace taut::cli {

/// `columns`: width in characters; none: unlimited.
std::string list_of_claims(const std::vector<const Claim*>& claims, std::optional<std::size_t> columns);
std::string claim_text(const Claim& claim, std::size_t columns);
std::string table_of_outcomes(const std::vector<ClaimOutcome>& outcomes, std::optional<std::size_t> columns);
std::string claims_markdown(const std::vector<Paper>& papers);

/// `outcome` may be nullptr.
Json claim_json(const Claim& claim, const ClaimOutcome* outcome);
TestReport claims_report(const std::vector<ClaimOutcome>& outcomes);

/// "taut run oscillating-plate --method og --until 0.05".
std::string command_of(const Claim& claim, const ClaimRun& run);

}  // namespace taut::cli
