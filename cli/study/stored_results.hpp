#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace taut::cli {

/// Prefix of swept names in results.csv: "set.v0".
inline constexpr std::string_view set_prefix = "set.";

using StoredSettings = std::vector<std::pair<std::string, std::string>>;

/// A row of a sweep's results.csv.
struct StoredRun {
  std::string file;      // results.csv
  StoredSettings cells;  // non-empty cells by column; "fixed.until": set for all runs

  /// Empty if unknown.
  std::string text(std::string_view column) const;
  std::optional<double> number(std::string_view column) const;
  /// Whether it finished or diverged.
  bool has_result() const;
  std::string method() const;  // known without a result if swept
  std::string folder() const;  // located from results.csv
  bool is_stable() const { return has_result() && text("verdict") == "stable"; }
};

/// Runs of one scene from one or more sweeps.
struct StoredResults {
  std::string title;  // of the first sweep, else the scene
  std::string scene;
  std::map<std::string, std::string> units;  // of swept parameters, if known
  StoredSettings fixed;                      // common settings of all sweeps
  std::vector<StoredRun> runs;

  /// In the scene's order.
  std::vector<std::string> measures() const;
  /// "v0, c0".
  std::string label(const std::string& name) const;
};

/// Reads results.csv, or the one in a sweep's folder. Throws UsageError for other files, several scenes, and without
/// any result.
StoredResults read_results(const std::vector<std::string>& files);

/// Reads a run folder or run.json. Throws UsageError for anything else.
StoredRun read_stored_run(const std::string& path);

/// Removes runs of other methods; `methods` empty: none. Throws UsageError for a method without runs.
void keep_methods(StoredResults& results, const std::vector<std::string>& methods);

/// Columns that distinguish runs with equal method and `x`. A setting represents the parameters that depend on it.
std::vector<std::string> distinguishing_columns(const std::vector<StoredRun>& runs, const std::string& x);
/// Names set for the scene, not for its simulation: "v0", "until", "law".
std::vector<std::string> names_of_scene(const std::vector<StoredRun>& runs);
/// Value, set or default; empty if unknown.
std::string value_of(const StoredRun& run, const std::string& name);
/// "enog, cfl=0.5".
std::string series_name(const StoredRun& run, const std::vector<std::string>& columns);

}  // namespace taut::cli
