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
  bool found = true;     // the program is installed
  bool stopped = false;  // by an interrupt
  bool late = false;     // stopped by the time limit
  int code = 0;          // exit code, or 128 + signal
  std::string errors;    // end of stderr
};

/// Runs a program from the absolute folders of PATH in `folder`, without a shell: no argument has a special meaning. Its
/// stdin and stdout are empty. An interrupt stops it, and so does the end of `limit`.
ProcessResult run_process(std::vector<std::string> arguments, const std::filesystem::path& folder,
                          const Interrupts& interrupts,
                          std::optional<std::chrono::seconds> limit = std::nullopt);

/// An external program that writes a file.
struct Maker {
  std::string name;     // in PATH
  std::string purpose;  // "movies"
  std::string package;  // in Debian
};

/// The arguments that make a program write the file at this absolute path: "…/movie.mp4.part/movie.mp4" for
/// "movie.mp4".
using MakerArguments = std::function<std::vector<std::string>(const std::filesystem::path& unfinished)>;

/// Runs `maker` in `folder` and renames the complete file that it wrote to `file`. Returns exit_fine or the code of an
/// interrupt. Throws OutputError if the program is missing or fails; no file remains then.
int make_file(const Maker& maker, const MakerArguments& arguments, const std::filesystem::path& folder,
              const std::filesystem::path& file);

}  // namespace taut::cli
