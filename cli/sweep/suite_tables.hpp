#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/sweep/suite_record.hpp"
#include "cli/sweep/suite_runs.hpp"
#include "cli/text/json.hpp"
#include "cli/text/test_report.hpp"

namespace taut::cli {

/// `columns`: width of the text.
std::string list_of_entries(const std::vector<PlannedEntry>& entries, std::optional<std::size_t> columns);
std::string table_of_outcomes(const std::vector<EntryOutcome>& outcomes, std::optional<std::size_t> columns);

/// `outcome`: nullptr if the entry was not run.
Json entry_json(const PlannedEntry& planned, const EntryOutcome* outcome);
/// One case per control, updated entry and entry without result; for other entries, one per frame.
TestReport suite_report(const SuiteFile& suite, const std::vector<EntryOutcome>& outcomes);
SuiteRecord record_of(const SuiteFile& suite, const SuiteOptions& options,
                      const std::vector<EntryOutcome>& outcomes);

}  // namespace taut::cli
