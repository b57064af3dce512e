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
  std::filesystem::path out;                       // folder of the runs
  std::optional<std::filesystem::path> baselines;  // instead of those of the file
  std::vector<std::string> only;                   // names of entries; empty: all
  bool update = false;                             // makes the baselines; controls have none
  int threads = 1;                                 // of each run
};

/// An entry with its validated run.
struct PlannedEntry {
  SuiteEntry entry;
  Baseline baseline;  // of a control: that of the entry from which it differs
  SweepRun run;

  render::DifferenceLimit limit() const;
};

/// Checks the runs and baselines of the chosen entries; with `needs_baselines`, all must exist unless they are made.
/// Throws SceneError with the place in the suite file, and
/// UsageError for unknown names and missing baselines.
std::vector<PlannedEntry> plan_suite(const SuiteFile& suite, const SuiteOptions& options,
                                     bool needs_baselines = true);

enum class EntryResult { alike, warning, different, control_differs, control_alike, updated, no_result };
/// "alike, with a warning".
std::string_view name(EntryResult result);

struct EntryOutcome {
  const PlannedEntry* planned;
  EntryResult result = EntryResult::no_result;
  FolderDifference difference{};  // of the baseline and the frames
  std::size_t updated = 0;        // number of new frames in the baseline
  std::string problem{};          // without result: the reason

  bool passed() const;
};

/// Compares the frames of a run with the baseline.
EntryOutcome compare_entry(const PlannedEntry& planned);
/// Replaces the baselines by the frames, if all runs have results: else the old ones stay. Throws OutputError.
std::vector<EntryOutcome> update_entries(const std::vector<PlannedEntry>& entries);

}  // namespace taut::cli
