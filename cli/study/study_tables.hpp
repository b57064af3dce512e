#pragma once

#include <string>
#include <vector>

#include "cli/study/study.hpp"

namespace taut::cli {

/// Tables of errors, prices, verdicts and measures. Throws UsageError.
std::string study_tables(const StudyPictures& pictures, const std::vector<std::string>& results);

}  // namespace taut::cli
