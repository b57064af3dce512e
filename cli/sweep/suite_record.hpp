#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace taut::cli {

/// The file suite.json in the folder of a suite's runs, for `taut report`: the comparisons of the last call.
struct SuiteRecord {
  struct Entry {
    std::string name;                  // also of its run folder
    std::filesystem::path baseline;    // relative to the folder
    std::string differs_from;          // of a control
    std::optional<double> warn, fail;  // ΔE*ab
    std::string problem;               // reason why the run has no frames to compare, or empty
  };
  std::string title, file;  // of the suite
  std::vector<Entry> entries;
};

/// Throws OutputError.
void write_suite_record(const std::filesystem::path& folder, const SuiteRecord& record);
bool has_suite_record(const std::filesystem::path& folder);
/// Throws UsageError for a missing or damaged file.
SuiteRecord read_suite_record(const std::filesystem::path& folder);

}  // namespace taut::cli
