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
  std::string verdict;          // empty: none
  std::string status;           // "finished", "error", "to do", ...
  std::optional<double> since;  // start of the verdict, s
};

/// Verdicts by value and method; a row per method and other settings.
struct StabilityMap {
  std::string title, scene;
  std::string parameter;
  std::string label;
  std::vector<std::string> values;  // ascending
  std::vector<std::string> rows;
  std::vector<std::vector<std::optional<MapCell>>> cells;  // by row and value
};

/// Throws UsageError for an unknown parameter, or if it is missing and several were swept.
StabilityMap make_map(const StoredResults& results, const MapRequest& request);

std::string map_table(const StabilityMap& map);
std::string markdown(const StabilityMap& map);
Json to_json(const StabilityMap& map);

}  // namespace taut::cli
