#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace taut::cli {

/// Prefix of swept names in results.csv.
inline constexpr std::string_view set_prefix = "set.";

using StoredSettings = std::vector<std::pair<std::string, std::string>>;

/// A row of results.csv.
struct StoredRun {
  std::string file;      // results.csv
  StoredSettings cells;  // without empty ones; "fixed.until": set for all runs

  std::string text(std::string_view column) const;
  std::optional<double> number(std::string_view column) const;
  /// Whether it finished or diverged.
  bool has_result() const;
  std::string method() const;  // known before a result if swept
  std::string folder() const;
  bool is_stable() const { return has_result() && text("verdict") == "stable"; }
};

/// Runs of one scene from several sweeps.
struct StoredResults {
  std::string title;  // of a sweep, else the scene
  std::string scene;
  std::map<std::string, std::string> units;  // of swept parameters
  StoredSettings fixed;                      // settings of all sweeps
  std::vector<StoredRun> runs;

  std::vector<std::string> measures() const;
  /// "v0, c0".
  std::string label(const std::string& name) const;
};

/// Reads results.csv, also in a sweep's folder. Throws UsageError for other files, several scenes, or without
/// results.
StoredResults read_results(const std::vector<std::string>& files);

/// Reads a run folder or run.json. Throws UsageError for others.
StoredRun read_stored_run(const std::string& path);

/// Removes runs of other methods, if `methods` are given. Throws UsageError for one without runs.
void keep_methods(StoredResults& results, const std::vector<std::string>& methods);

/// Columns that distinguish runs of equal method and `x`. A setting represents dependent parameters.
std::vector<std::string> distinguishing_columns(const std::vector<StoredRun>& runs, const std::string& x);
/// Names set for the scene, not its simulation: "v0", "until", "law".
std::vector<std::string> names_of_scene(const std::vector<StoredRun>& runs);
/// Value of a name, set or default, or "".
std::string value_of(const StoredRun& run, const std::string& name);
/// "enog, cfl=0.5".
std::string series_name(const StoredRun& run, const std::vector<std::string>& columns);

}  // namespace taut::cli
