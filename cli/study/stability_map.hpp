#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/study/stored_results.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

struct MapRequest {
  std::string parameter;  // empty: the only one
  std::string measure{};  // empty: the verdict colours cells
};

struct MapCell {
  std::string verdict;          // empty: see `status`
  std::string status;           // "finished", "to do"
  std::optional<double> since;  // start of the verdict, s
  std::optional<double> value{};
};

/// A method has a row per combination of other settings.
struct StabilityMap {
  std::string title, scene;
  std::string parameter;
  std::string label;                                       // with unit
  std::optional<ResultColumn> measure;                     // colours the cells
  std::vector<std::string> values;                         // numbers ascend
  std::vector<std::string> rows;                           // names of series
  std::vector<std::vector<std::optional<MapCell>>> cells;  // by row and value
};

/// `wanted`, or the only one. Throws UsageError for an unknown or missing choice.
std::string swept_parameter(const std::vector<StoredRun>& runs, const std::string& wanted,
                            std::string_view option);

/// Throws UsageError like swept_parameter(), and for a measure that is unknown or without values.
StabilityMap make_map(const StoredResults& results, const MapRequest& request);

std::string map_table(const StabilityMap& map);
std::string markdown(const StabilityMap& map);
Json to_json(const StabilityMap& map);

}  // namespace taut::cli
