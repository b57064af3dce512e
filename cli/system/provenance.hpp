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

/// Raise a number if old readers would misread the format; for checkpoint.bin also if `serialize` or a step's result
/// changes.
inline constexpr std::array<FileFormat, 9> file_formats{{{"run.json", 1},
                                                         {"results.json", 1},
                                                         {"results.csv", 1},
                                                         {"history.csv", 1},
                                                         {"lines.csv", 1},
                                                         {"particles", 2},
                                                         {"look.json", 1},
                                                         {"suite.json", 1},
                                                         {"checkpoint.bin", 16}}};

consteval int format_of(std::string_view file) {
  for (const FileFormat& format : file_formats)
    if (format.file == file) return format.number;
  throw "no such kind of file";
}

std::string version_text();

std::string host_name();

class Provenance {
 public:
  /// Measures times until this call.
  Json to_json() const;

 private:
  std::time_t start_ = std::time(nullptr);
  Stopwatch wall_;
  CpuStopwatch cpu_;
  MachineLoad load_;
};

}  // namespace taut::cli
