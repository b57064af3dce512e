#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace taut::cli {

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// RFC 4180. Throws UsageError for malformed rows.
CsvTable parse_csv(const std::string& text, const std::string& file);
/// Throws UsageError.
CsvTable read_csv(const std::filesystem::path& path);

std::string csv_cell(const std::string& text);

}  // namespace taut::cli
