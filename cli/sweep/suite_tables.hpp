#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/sweep/suite_record.hpp"
#include "cli/sweep/suite_runs.hpp"
#include "cli/text/json.hpp"
#include "cli/text/test_report.hpp"

namespace taut::cli {

/// Entries with scene, settings and baseline. `columns`: width of the text.
std::string list_of_entries(const std::vector<PlannedEntry>& entries, std::optional<std::size_t> columns);
/// Results, then every frame that differs, warns or is missing, except those of controls.
std::string table_of_outcomes(const std::vector<EntryOutcome>& outcomes, std::optional<std::size_t> columns);

/// `outcome`: nullptr for an entry that was not run.
Json entry_json(const PlannedEntry& planned, const EntryOutcome* outcome);
/// A case for each frame; one for each control and each entry without result.
TestReport suite_report(const SuiteFile& suite, const std::vector<EntryOutcome>& outcomes);
SuiteRecord record_of(const SuiteFile& suite, const SuiteOptions& options,
                      const std::vector<EntryOutcome>& outcomes);

}  // namespace taut::cli
