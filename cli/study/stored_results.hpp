#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/run/record.hpp"

namespace taut::cli {

/// Columns of swept names: "set.v0".
inline constexpr std::string_view set_prefix = "set.";

using StoredSettings = std::vector<std::pair<std::string, std::string>>;

/// Row of results.csv, or a run.json.
struct StoredRun {
  std::string file;
  std::string status = {};  // of the record, or "to do", "error"
  RunRecord record = {};
  StoredSettings cells = {};  // by column: "set.v0"
  Json all = {};              // of run.json

  /// Cell, or "". Prefer the members of `record`.
  std::string text(std::string_view column) const;
  bool has_result() const { return status == "finished" || status == "failed"; }
  std::string method() const;  // empty if unknown
  std::string folder() const;
  std::string verdict() const { return record.verdict ? std::string(name(*record.verdict)) : ""; }
  bool is_stable() const { return has_result() && record.verdict == Verdict::stable; }
  /// Nullopt unless finite.
  std::optional<double> value_of(std::string_view measure) const;

  mutable std::vector<std::uint32_t> by_column = {};  // order of `cells` by column, made by `text`
};

/// Runs of sweeps or run folders.
struct StoredResults {
  std::string title;
  std::string scene;
  std::map<std::string, std::string> units;  // by parameter
  StoredSettings fixed;                      // common to all sweeps
  std::vector<StoredRun> runs;

  std::vector<std::string> measures() const;
  /// "until, s"
  std::string label(const std::string& name) const;
};

/// `files`: results.csv or folders of sweeps. Throws UsageError, also without results and for several scenes.
StoredResults read_results(const std::vector<std::string>& files);

/// `path`: run folder or run.json. Throws UsageError.
StoredRun read_stored_run(const std::string& path);

/// Does nothing for empty `methods`. Throws UsageError for a method without runs.
void keep_methods(StoredResults& results, const std::vector<std::string>& methods);

/// Columns that distinguish runs of equal method and `x`, without parameters that follow from listed settings.
std::vector<std::string> distinguishing_columns(const std::vector<StoredRun>& runs, const std::string& x);
/// Settings of the scene, not of its simulation: "v0", "until".
std::vector<std::string> names_of_scene(const std::vector<StoredRun>& runs);
/// Value, set or default; "" if unknown.
std::string value_of(const StoredRun& run, const std::string& name);
struct ResultColumn {
  std::string name;    // "deflection (error)", "v0"
  std::string column;  // empty: no measure, see value_of()
  std::string unit{};
  std::string measure{};  // empty: another quantity
  bool is_share = false;
  std::string relative_to{};  // measure of a relative error

  std::string text(const StoredRun& run) const;
  /// Finite, in `unit`. Nullopt for an absolute error in a column of relative errors.
  std::optional<double> number(const StoredRun& run) const;
};
/// Throws UsageError for an unknown name.
ResultColumn find_result_column(const StoredResults& results, const std::string& name);
/// "enog, cfl=0.5".
std::string series_name(const StoredRun& run, const std::vector<std::string>& columns);

}  // namespace taut::cli
