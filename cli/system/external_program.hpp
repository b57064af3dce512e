#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/system/interrupts.hpp"

namespace taut::cli {

/// How a program that was started has ended.
struct ProcessResult {
  bool found = true;     // it is installed
  bool stopped = false;  // by an interrupt
  int code = 0;          // its exit code, or 128 + the signal that ended it
  std::string errors;    // the end of what it wrote to stderr
};

/// Runs a program, found by its name in the absolute folders of PATH, in `folder`, without a shell: no argument has a
/// special meaning. Its stdin and stdout are empty. An interrupt ends it.
ProcessResult run_process(std::vector<std::string> arguments, const std::filesystem::path& folder,
                          const Interrupts& interrupts);

/// Another program that makes a file.
struct Maker {
  std::string name;     // in PATH
  std::string purpose;  // "movies"
  std::string package;  // of Debian
};

/// The arguments that make a program write the file at this absolute path: "…/movie.mp4.part/movie.mp4" for
/// "movie.mp4".
using MakerArguments = std::function<std::vector<std::string>(const std::filesystem::path& unfinished)>;

/// Runs `maker` in `folder`. The file that it writes is moved to `file` when it is whole. Gives the exit code: fine or
/// interrupted. Throws OutputError when the program is not installed or fails; then there is no such file.
int make_file(const Maker& maker, const MakerArguments& arguments, const std::filesystem::path& folder,
              const std::filesystem::path& file);

}  // namespace taut::cli
