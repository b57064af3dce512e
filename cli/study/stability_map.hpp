#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/stored_results.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

struct MapRequest {
  std::string parameter;  // empty: the only one besides the method
};

struct MapCell {
  std::string verdict;          // empty: none, see `status`
  std::string status;           // "finished", "error", "to do", ...
  std::optional<double> since;  // start of the verdict, s; none if stable
};

/// Verdicts by value of a parameter and by method. A method has a row for each combination of other settings.
struct StabilityMap {
  std::string title, scene;
  std::string parameter;
  std::string label;                                       // of the parameter, with its unit
  std::vector<std::string> values;                         // of the parameter; numbers ascend
  std::vector<std::string> rows;                           // methods
  std::vector<std::vector<std::optional<MapCell>>> cells;  // by row and value
};

/// Throws UsageError for an unknown parameter, or if none is requested and several were swept.
StabilityMap make_map(const StoredResults& results, const MapRequest& request);

std::string map_table(const StabilityMap& map);
std::string markdown(const StabilityMap& map);
Json to_json(const StabilityMap& map);

}  // namespace taut::cli
