#pragma once

#include <string>
#include <vector>

#include "cli/study/study.hpp"

namespace taut::cli {

/// Markdown page: errors and prices of each chart, verdicts of the map, measures. `results` as for
/// read_results(). Throws UsageError.
std::string study_tables(const StudyPictures& pictures, const std::vector<std::string>& results);

}  // namespace taut::cli
