#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/run/baseline.hpp"
#include "cli/run/frame_folders.hpp"
#include "cli/sweep/plan.hpp"
#include "cli/sweep/suite_file.hpp"

namespace taut::cli {

struct SuiteOptions {
  std::filesystem::path out;
  std::optional<std::filesystem::path> baselines;
  std::vector<std::string> only;  // entry names; empty: all
  bool update = false;
  int threads = 1;  // of each run
};

struct PlannedEntry {
  SuiteEntry entry;
  Baseline baseline;  // for a control, of `differs_from`
  SweepRun run;

  render::DifferenceLimit limit() const;
};

/// With `needs_baselines`, all baselines must exist unless `options.update` makes them. Throws SceneError, and
/// UsageError for unknown names and missing baselines.
std::vector<PlannedEntry> plan_suite(const SuiteFile& suite, const SuiteOptions& options,
                                     bool needs_baselines = true);

enum class EntryResult { alike, warning, different, control_differs, control_alike, updated, no_result };
/// "alike, with a warning".
std::string_view name(EntryResult result);

struct EntryOutcome {
  const PlannedEntry* planned;
  EntryResult result = EntryResult::no_result;
  FolderDifference difference{};
  std::size_t updated = 0;
  std::string problem{};  // why there is no result

  bool passed() const;
};

EntryOutcome compare_entry(const PlannedEntry& planned);
/// Keeps the old baselines unless all runs have results. Throws OutputError.
std::vector<EntryOutcome> update_entries(const std::vector<PlannedEntry>& entries);

}  // namespace taut::cli
