#pragma once

#include <array>
#include <ctime>
#include <string>
#include <string_view>

#include "cli/system/machine.hpp"
#include "cli/system/stopwatch.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

struct FileFormat {
  std::string_view file;
  int number;
};

/// Format number of each kind of file. Raise a number if old readers would misread the new format; for checkpoint.bin
/// also if a `serialize` or the bytes of a step change.
inline constexpr std::array<FileFormat, 9> file_formats{{{"run.json", 1},
                                                         {"results.json", 1},
                                                         {"results.csv", 1},
                                                         {"history.csv", 1},
                                                         {"lines.csv", 1},
                                                         {"particles", 1},
                                                         {"look.json", 1},
                                                         {"suite.json", 1},
                                                         {"checkpoint.bin", 15}}};

consteval int format_of(std::string_view file) {
  for (const FileFormat& format : file_formats)
    if (format.file == file) return format.number;
  throw "no such kind of file";
}

/// Text of --version; the first line has name, version and commit.
std::string version_text();

std::string host_name();

/// Origin of a record: the build, and the process since construction.
class Provenance {
 public:
  /// The object for run.json, with the times until now.
  Json to_json() const;

 private:
  std::time_t start_ = std::time(nullptr);
  Stopwatch wall_;
  CpuStopwatch cpu_;
  MachineLoad load_;
};

}  // namespace taut::cli
