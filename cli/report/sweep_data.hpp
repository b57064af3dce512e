#pragma once

#include <string>
#include <vector>

#include "cli/report/links.hpp"
#include "cli/study/stored_results.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

Json sweep_data(const StoredResults& results, const Links& links);

bool has_run_folder(const StoredRun& run);

}  // namespace taut::cli
