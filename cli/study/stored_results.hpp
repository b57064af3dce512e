#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace taut::cli {

/// Before the name of what was set, in the columns of results.csv: "set.v0".
inline constexpr std::string_view set_prefix = "set.";

/// Names with their values, as they were given.
using StoredSettings = std::vector<std::pair<std::string, std::string>>;

/// A row of the results.csv of a sweep.
struct StoredRun {
  std::string file;  // results.csv
  StoredSettings
      cells;  // by column, "set.v0", and "fixed.until" of what the sweep set for all; none that is empty

  /// Empty where there is nothing.
  std::string text(std::string_view column) const;
  std::optional<double> number(std::string_view column) const;
  /// It ran to its end or diverged; one that was stopped, broke or has not begun has no result.
  bool has_result() const;
  std::string method() const;  // also of a run without a result, where the grid has it
  std::string folder() const;  // of the run, beside results.csv
  bool is_stable() const { return has_result() && text("verdict") == "stable"; }

  mutable std::vector<std::uint32_t> by_column =
      {};  // places of cells, made by `text`: there may be 10 000 columns
};

/// The runs of one scene from one or more sweeps.
struct StoredResults {
  std::string title;                         // of the first sweep; else the scene
  std::string scene;                         // its name
  std::map<std::string, std::string> units;  // of swept parameters, as far as a results.json beside tells
  StoredSettings fixed;                      // what all of the sweeps set for all of their runs, from there
  std::vector<StoredRun> runs;

  /// The measures of the scene, in its order.
  std::vector<std::string> measures() const;
  /// "v0, c0"
  std::string label(const std::string& name) const;
};

/// Each of `files` is a results.csv of a sweep, or the folder of the sweep. Throws UsageError for files that
/// cannot be read, are none of these, hold no result, or are of different scenes.
StoredResults read_results(const std::vector<std::string>& files);

/// A run by itself, from its folder or its run.json, with the same columns. Throws UsageError for what is
/// neither.
StoredRun read_stored_run(const std::string& path);

/// Leaves away the runs of all other methods, and runs without a method. Throws UsageError for a method that
/// no run has, with the nearest names; no names: all of them stay.
void keep_methods(StoredResults& results, const std::vector<std::string>& methods);

/// The columns in which runs differ although they agree in method and in `x`: "set.cfl", ... What makes a
/// parameter differ (because it was set, or another one that it depends on) stands for it.
std::vector<std::string> distinguishing_columns(const std::vector<StoredRun>& runs, const std::string& x);
/// The names of what runs were asked for of the scene itself, not of how it is simulated: "v0", "until", "law".
std::vector<std::string> names_of_scene(const std::vector<StoredRun>& runs);
/// What a run had of such a name, asked for or not; empty where no table tells.
std::string value_of(const StoredRun& run, const std::string& name);
/// "enog, cfl=0.5": the method of a run and its cells in these columns.
std::string series_name(const StoredRun& run, const std::vector<std::string>& columns);

}  // namespace taut::cli
