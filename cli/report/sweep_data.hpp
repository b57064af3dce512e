#pragma once

#include <string>
#include <vector>

#include "cli/report/links.hpp"
#include "cli/study/stored_results.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

/// The data of sweeps that a page shows: a table with a row per run, the swept names, the styles of the methods, and the
/// pictures that a study has drawn.
Json sweep_data(const StoredResults& results, const Links& links);

/// Whether the folder of the run contains a run.
bool has_run_folder(const StoredRun& run);

}  // namespace taut::cli
