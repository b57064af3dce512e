#pragma once

#include <string>
#include <vector>

namespace taut::cli {

/// A table of Markdown; the first row holds its heads. Vertical bars are escaped, line breaks become blanks.
std::string markdown_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace taut::cli
