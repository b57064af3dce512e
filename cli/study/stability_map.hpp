#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/study/stored_results.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

struct MapRequest {
  std::string parameter;  // empty: the only one besides the method
  std::string measure{};  // colours cells; empty: their verdict does
};

struct MapCell {
  std::string verdict;            // empty: none, see `status`
  std::string status;             // "finished", "error", "to do", ...
  std::optional<double> since;    // start of the verdict, s; none if stable
  std::optional<double> value{};  // of the measure
};

/// Verdicts by value of a parameter and by method. A method has a row for each combination of other settings.
struct StabilityMap {
  std::string title, scene;
  std::string parameter;
  std::string label;                                       // of the parameter, with its unit
  std::optional<ResultColumn> measure;                     // that colours the cells
  std::vector<std::string> values;                         // of the parameter; numbers ascend
  std::vector<std::string> rows;                           // methods
  std::vector<std::vector<std::optional<MapCell>>> cells;  // by row and value
};

/// Returns `wanted`, or the only parameter that was swept beside the method. Throws UsageError for an unknown parameter,
/// or if none is wanted and several were swept; the message names `option`.
std::string swept_parameter(const std::vector<StoredRun>& runs, const std::string& wanted,
                            std::string_view option);

/// Throws UsageError as swept_parameter(), and for a measure that is unknown or without values.
StabilityMap make_map(const StoredResults& results, const MapRequest& request);

std::string map_table(const StabilityMap& map);
std::string markdown(const StabilityMap& map);
Json to_json(const StabilityMap& map);

}  // namespace taut::cli
