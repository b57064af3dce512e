#pragma once

#include <cstddef>
#include <filesystem>

#include "cli/report/links.hpp"
#include "cli/study/curve_style.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

/// Thins a history of more than `most_rows` rows evenly. Throws UsageError without a valid run.json.
Json run_data(const std::filesystem::path& folder, const Links& links, std::size_t most_rows);

Json to_json(const CurveStyle& style);

}  // namespace taut::cli
