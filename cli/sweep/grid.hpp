#pragma once

#include <string>
#include <vector>

#include "cli/scene/scene_file.hpp"

namespace taut::cli {

using GridRow = std::vector<Setting>;

inline constexpr int most_repetitions = 100;

struct Axis {
  std::string name;
  std::vector<Setting> values;
};

/// Parses "v1,v2,..." or "lo:hi:step" with both ends. Commas in parentheses belong to expressions. Numbers become
/// canonical. Throws UsageError for a step that does not divide the range, and for repeated or empty values.
std::vector<std::string> parse_values(const std::string& text);
/// Parses "name=values". Throws UsageError.
Axis parse_axis(const std::string& text);
/// Shortest form of a number; trims other texts.
std::string canonical_value(const std::string& text);

/// The last axis varies fastest. Throws UsageError for repeated axes and too many runs.
std::vector<GridRow> all_combinations(const std::vector<Axis>& axes);
/// Throws UsageError for too many or repeated runs.
void check_rows(const std::vector<GridRow>& rows);

/// "v0=0.06_method=og", with a hash if characters were replaced or cut.
std::string folder_name(const GridRow& row);
/// "v0=0.06, method=og".
std::string text_of(const GridRow& row);

}  // namespace taut::cli
