#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/system/interrupts.hpp"

namespace taut::cli {

struct ProcessResult {
  bool found = true;     // installed
  bool stopped = false;  // by an interrupt
  int code = 0;          // exit code, or 128 + signal
  std::string errors;    // end of stderr
};

/// Runs a program from PATH in `folder`, without a shell, stdin or stdout. An interrupt stops it.
ProcessResult run_process(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                          const Interrupts& interrupts);

/// An external program that writes a file.
struct Maker {
  std::string name;     // in PATH
  std::string purpose;  // "movies"
  std::string package;  // in Debian
};

/// "a/movie.mp4" → "a/movie.part.mp4": keeps the extension, because programs take the format from it.
std::filesystem::path unfinished(const std::filesystem::path& file);

/// Runs `maker` to write unfinished(file), then renames it. Returns exit_fine or the code of an interrupt. Throws
/// OutputError and removes the file if the program is missing or fails.
int make_file(const Maker& maker, const std::vector<std::string>& arguments,
              const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace taut::cli
