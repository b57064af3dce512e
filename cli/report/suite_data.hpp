#pragma once

#include <filesystem>

#include "cli/report/links.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

/// Writes difference pictures into `pictures`, a folder per entry. Throws UsageError and OutputError.
Json suite_data(const std::filesystem::path& suite, const std::filesystem::path& pictures,
                const Links& links);

}  // namespace taut::cli
