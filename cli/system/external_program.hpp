#pragma once

#include <filesystem>
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

/// Runs a program from PATH in `folder`, without shell, stdin and stdout. An interrupt stops it.
ProcessResult run_process(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                          const Interrupts& interrupts);

struct Maker {
  std::string name;
  std::string purpose;  // "movies"
  std::string package;
};

/// "a/movie.mp4" → "a/movie.part.mp4": programs take the format from the extension.
std::filesystem::path unfinished(const std::filesystem::path& file);

/// Runs `maker`, which writes unfinished(file), and renames this file. Returns exit_fine or the code of an interrupt.
/// Throws OutputError if the program is missing or fails.
int make_file(const Maker& maker, const std::vector<std::string>& arguments,
              const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace taut::cli
