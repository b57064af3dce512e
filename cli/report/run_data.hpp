#pragma once

#include <cstddef>
#include <filesystem>

#include "cli/report/links.hpp"
#include "cli/study/curve_style.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

/// The data of a run that a page shows: its record, scene, frames with times, history and reference curves. A history
/// with more than `most_rows` rows is thinned evenly. Throws UsageError if the folder is not a run folder.
Json run_data(const std::filesystem::path& folder, const Links& links, std::size_t most_rows);

Json to_json(const CurveStyle& style);

}  // namespace taut::cli
