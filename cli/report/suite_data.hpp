#pragma once

#include <filesystem>

#include "cli/report/links.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

/// The data of a suite of snapshots that a page shows: title, and each entry with its comparison, as by
/// difference_data, or its problem. Writes pictures of the differences into `pictures`, a folder per entry. Throws
/// UsageError for a damaged suite.json, OutputError.
Json suite_data(const std::filesystem::path& suite, const std::filesystem::path& pictures,
                const Links& links);

}  // namespace taut::cli
