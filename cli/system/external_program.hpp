#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/system/interrupts.hpp"

namespace taut::cli {

struct ProcessResult {
  bool found = true;
  bool stopped = false;  // by an interrupt
  bool late = false;     // stopped by `limit`
  int code = 0;          // or 128 + signal
  std::string errors;    // end of stderr
};

/// Runs a program from the absolute folders of PATH without a shell. stdin is empty, stdout is discarded.
ProcessResult run_process(std::vector<std::string> arguments, const std::filesystem::path& folder,
                          const Interrupts& interrupts,
                          std::optional<std::chrono::seconds> limit = std::nullopt);

struct Maker {
  std::string name;     // in PATH
  std::string purpose;  // "movies"
  std::string package;  // in Debian
};

/// Arguments for writing `unfinished`: "…/movie.mp4.part/movie.mp4".
using MakerArguments = std::function<std::vector<std::string>(const std::filesystem::path& unfinished)>;

/// Runs `maker` in `folder` and renames the complete file. Returns exit_fine or the code of an interrupt.
/// Throws OutputError.
int make_file(const Maker& maker, const MakerArguments& arguments, const std::filesystem::path& folder,
              const std::filesystem::path& file);

}  // namespace taut::cli
