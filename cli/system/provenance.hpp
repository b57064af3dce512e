#pragma once

#include <array>
#include <ctime>
#include <string>
#include <string_view>

#include "cli/system/stopwatch.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

struct FileFormat {
  std::string_view file;
  int number;
};

/// Format number of each kind of file. Raise it when a reader of the old format misreads the new one; for
/// checkpoint.bin also when a `serialize` changes, or when a step gives other bytes.
inline constexpr std::array<FileFormat, 7> file_formats{{{"run.json", 1},
                                                         {"results.json", 1},
                                                         {"results.csv", 1},
                                                         {"history.csv", 1},
                                                         {"lines.csv", 1},
                                                         {"particles", 1},
                                                         {"checkpoint.bin", 14}}};

consteval int format_of(std::string_view file) {
  for (const FileFormat& format : file_formats)
    if (format.file == file) return format.number;
  throw "no such kind of file";
}

/// Output of `taut --version`; the first line contains only name, version and commit.
std::string version_text();

std::string host_name();

/// Origin of a record: the build, and the process from the construction of this object on.
class Provenance {
 public:
  /// The object for run.json, with the times up to now.
  Json to_json() const;

 private:
  std::time_t start_ = std::time(nullptr);
  Stopwatch wall_;
  CpuStopwatch cpu_;
};

}  // namespace taut::cli
