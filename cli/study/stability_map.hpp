#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/stored_results.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

/// Choice of the swept parameter of a map.
struct MapRequest {
  std::string parameter;  // empty: the one that was swept beside the method
};

/// End of one run.
struct MapCell {
  std::string verdict;          // empty: it has none, see status
  std::string status;           // "finished", "error", "to do", ...
  std::optional<double> since;  // of the verdict, s; none for a stable run
};

/// Values of a parameter × methods → verdicts. A method has a row for each choice of everything else.
struct StabilityMap {
  std::string title, scene;
  std::string parameter;
  std::string label;                                       // of the parameter, with its unit
  std::vector<std::string> values;                         // of it; numbers ascend
  std::vector<std::string> rows;                           // methods, in the order of the results
  std::vector<std::vector<std::optional<MapCell>>> cells;  // by row and value
};

/// Throws UsageError for a parameter that no run has (with the nearest names), or when several were swept and
/// none is named.
StabilityMap make_map(const StoredResults& results, const MapRequest& request);

/// For a terminal: a line for each method.
std::string map_table(const StabilityMap& map);
/// The same as Markdown.
std::string markdown(const StabilityMap& map);
/// The same as JSON.
Json to_json(const StabilityMap& map);

}  // namespace taut::cli
