#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace taut::cli {

/// A table in which every row has a cell per column.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Parses CSV (RFC 4180). Throws UsageError, with the line, for a row whose number of cells differs from the first
/// row.
CsvTable parse_csv(const std::string& text, const std::string& file);
/// Reads a CSV file. Throws UsageError, also for an unreadable file.
CsvTable read_csv(const std::filesystem::path& path);

/// Quotes a cell if necessary.
std::string csv_cell(const std::string& text);

}  // namespace taut::cli
