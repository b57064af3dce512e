#pragma once

#include <string>
#include <vector>

#include "cli/study/study.hpp"

namespace taut::cli {

/// Markdown page with errors and prices of each chart, verdicts of the map if there is one, and measures of all runs if
/// there is a [history]. `results` as for read_results(). Throws UsageError.
std::string study_tables(const StudyPictures& pictures, const std::vector<std::string>& results);

}  // namespace taut::cli
