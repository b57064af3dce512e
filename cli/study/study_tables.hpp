#pragma once

#include <string>
#include <vector>

#include "cli/study/study.hpp"

namespace taut::cli {

/// Markdown page with the tables behind a study's pictures: errors and prices of each chart, verdicts of the map, and
/// measures of the runs. `results` as for read_results(). Throws UsageError.
std::string study_tables(const StudyPictures& pictures, const std::vector<std::string>& results);

}  // namespace taut::cli
