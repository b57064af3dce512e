#pragma once

#include <string>
#include <vector>

#include "cli/scene/scene_file.hpp"

namespace taut::cli {

/// What one run of a sweep sets.
using GridRow = std::vector<Setting>;

/// One name and all its values.
struct Axis {
  std::string name;
  std::vector<Setting> values;
};

/// "v1,v2,..." or "lo:hi:step", both ends included: the values lo + k·step, without their round-off. Commas
/// inside brackets belong to an expression. Numbers come back in their shortest form. Throws UsageError for a
/// step that does not lead from lo to hi, and for a value that stands there twice.
std::vector<std::string> parse_values(const std::string& text);
/// "name=values". Throws UsageError.
Axis parse_axis(const std::string& text);
/// The shortest form of a number; any other text without the blanks around it.
std::string canonical_value(const std::string& text);

/// Every combination, the last axis fastest. Throws UsageError for an axis that is given twice.
std::vector<GridRow> all_combinations(const std::vector<Axis>& axes);
/// Throws UsageError when there are more runs than a sweep can hold, or two are the same.
void check_rows(const std::vector<GridRow>& rows);

/// A folder name that says what a row sets ("v0=0.06_method=og"): letters, digits and ".=_+-" only. What does
/// not fit in, or is too long, is replaced by a hash of the whole.
std::string folder_name(const GridRow& row);
/// "v0=0.06, method=og", for people.
std::string text_of(const GridRow& row);

}  // namespace taut::cli
