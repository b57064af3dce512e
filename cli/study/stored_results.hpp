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

/// Prefix of swept names in the columns of results.csv: "set.v0".
inline constexpr std::string_view set_prefix = "set.";

using StoredSettings = std::vector<std::pair<std::string, std::string>>;

/// A row of results.csv, or a run.json.
struct StoredRun {
  std::string file;
  std::string status = {};    // of the record, or "to do", "error"
  RunRecord record = {};      // unknown members are empty
  StoredSettings cells = {};  // by column: "set.v0", "fixed.until" (set for all runs); no empty cells
  Json all = {};              // of a run.json

  /// A cell; empty if it is missing. Members of the record have a type.
  std::string text(std::string_view column) const;
  /// Whether it finished or diverged.
  bool has_result() const { return status == "finished" || status == "failed"; }
  std::string method() const;  // known before a result if swept
  std::string folder() const;  // of the run, beside results.csv
  std::string verdict() const { return record.verdict ? std::string(name(*record.verdict)) : ""; }
  bool is_stable() const { return has_result() && record.verdict == Verdict::stable; }
  /// Value of a measure, if it is finite.
  std::optional<double> value_of(std::string_view measure) const;

  mutable std::vector<std::uint32_t> by_column =
      {};  // places of cells, made by `text`: there may be 10 000 columns
};

/// Runs of one scene from several sweeps.
struct StoredResults {
  std::string title;  // of a sweep, else the scene
  std::string scene;
  std::map<std::string, std::string> units;  // of swept parameters, from results.json
  StoredSettings fixed;                      // common settings of all sweeps, from results.json
  std::vector<StoredRun> runs;

  std::vector<std::string> measures() const;
  /// "v0, c0".
  std::string label(const std::string& name) const;
};

/// Reads sweeps; each of `files` is a results.csv or the folder of a sweep. Throws UsageError for other or unreadable
/// files, files without results, and several scenes.
StoredResults read_results(const std::vector<std::string>& files);

/// Reads one run from its folder or run.json, with the same columns. Throws UsageError for other paths.
StoredRun read_stored_run(const std::string& path);

/// Removes the runs of other methods, unless `methods` is empty. Throws UsageError for a method without runs, with
/// the nearest names.
void keep_methods(StoredResults& results, const std::vector<std::string>& methods);

/// Columns that distinguish runs of equal method and `x`: "set.cfl". A setting also represents the parameters that
/// depend on it.
std::vector<std::string> distinguishing_columns(const std::vector<StoredRun>& runs, const std::string& x);
/// Names set for the scene, not its simulation: "v0", "until", "law".
std::vector<std::string> names_of_scene(const std::vector<StoredRun>& runs);
/// Value of a name, set or default; "" if unknown.
std::string value_of(const StoredRun& run, const std::string& name);
/// A quantity of results.csv: a measure's value, a setting, or any other column.
struct ResultColumn {
  std::string name;       // "deflection", "deflection.error", "v0"
  std::string column;     // "measures.deflection.value"; empty: a setting, see value_of()
  std::string unit{};     // SI, or "%"; empty: none
  std::string measure{};  // whose value it is; empty: another quantity
  bool is_share = false;  // drawn in %

  /// Cell of a run, or "".
  std::string text(const StoredRun& run) const;
  /// Finite number of a run, in `unit`.
  std::optional<double> number(const StoredRun& run) const;
};
/// Throws UsageError for an unknown name, with the nearest names.
ResultColumn find_result_column(const StoredResults& results, const std::string& name);
/// "enog, cfl=0.5": method and cells of these columns.
std::string series_name(const StoredRun& run, const std::vector<std::string>& columns);

}  // namespace taut::cli
