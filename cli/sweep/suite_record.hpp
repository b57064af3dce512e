#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace taut::cli {

/// Comparisons of the last call (suite.json).
struct SuiteRecord {
  struct Entry {
    std::string name;
    std::filesystem::path baseline;
    std::string differs_from;
    std::optional<double> warn, fail;  // ΔE*ab
    std::string problem;               // why there is no result, or empty
  };
  std::string title, file;
  std::vector<Entry> entries;
};

/// Throws OutputError.
void write_suite_record(const std::filesystem::path& folder, const SuiteRecord& record);
bool has_suite_record(const std::filesystem::path& folder);
/// Throws UsageError if missing or damaged.
SuiteRecord read_suite_record(const std::filesystem::path& folder);

}  // namespace taut::cli
