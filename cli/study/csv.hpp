#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace taut::cli {

/// A table with a name for each column; every row has as many cells.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Text as RFC 4180 has it: cells between commas, those with commas, quotes or line breaks in quotes. Throws
/// UsageError, with the line, for a row that has not as many cells as the first.
CsvTable parse_csv(const std::string& text, const std::string& file);
/// Throws UsageError for a file that cannot be read, as well.
CsvTable read_csv(const std::filesystem::path& path);

/// A cell as it stands in such a file.
std::string csv_cell(const std::string& text);

}  // namespace taut::cli
