#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/system/interrupts.hpp"

namespace taut::cli {

struct ProcessResult {
  bool found = true;
  bool stopped = false;
  int code = 0;        // exit code, or 128 + signal
  std::string errors;  // end of stderr
};

/// Runs a program from the absolute folders of PATH in `folder`, without shell, stdin and stdout. An interrupt stops it.
ProcessResult run_process(std::vector<std::string> arguments, const std::filesystem::path& folder,
                          const Interrupts& interrupts);

struct Maker {
  std::string name;
  std::string purpose;  // "movies"
  std::string package;
};

/// The arguments that make a program write the file at this absolute path: "…/movie.mp4.part/movie.mp4" for
/// "movie.mp4".
using MakerArguments = std::function<std::vector<std::string>(const std::filesystem::path& unfinished)>;

/// Runs `maker` in `folder` and renames the file that it wrote to `file`. Returns exit_fine or the code of an interrupt.
/// Throws OutputError if the program is missing or fails.
int make_file(const Maker& maker, const MakerArguments& arguments, const std::filesystem::path& folder,
              const std::filesystem::path& file);

}  // namespace taut::cli
