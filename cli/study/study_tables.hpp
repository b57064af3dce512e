#pragma once

#include <string>
#include <vector>

#include "cli/study/study.hpp"

namespace taut::cli {

/// Markdown page with the tables behind the pictures of a study: errors and prices of each chart, the verdicts of its
/// map, the measures of the runs whose histories it draws. `results` as for read_results(). Throws UsageError.
std::string study_tables(const StudyPictures& pictures, const std::vector<std::string>& results);

}  // namespace taut::cli
