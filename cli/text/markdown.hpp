#pragma once

#include <string>
#include <vector>

namespace taut::cli {

/// The first row is the header. Escapes vertical bars.
std::string markdown_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace taut::cli
