#pragma once

#include <string>
#include <vector>

#include "cli/study/study.hpp"

namespace taut::cli {

/// Markdown tables of charts and map and, with a [history], the measures of runs. `results` as for read_results().
/// Throws UsageError.
std::string study_tables(const StudyPictures& pictures, const std::vector<std::string>& results);

}  // namespace taut::cli
