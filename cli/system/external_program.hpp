#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/system/interrupts.hpp"

namespace taut::cli {

struct ProcessResult {
  bool found = true;     // the program is installed
  bool stopped = false;  // by an interrupt
  int code = 0;          // exit code, or 128 + signal
  std::string errors;    // end of stderr
};

/// Runs a program from PATH in `folder`, without a shell: no argument has a special meaning. Its stdin and stdout are
/// empty. An interrupt stops it.
ProcessResult run_process(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                          const Interrupts& interrupts);

/// An external program that writes a file.
struct Maker {
  std::string name;     // in PATH
  std::string purpose;  // "movies"
  std::string package;  // in Debian
};

/// "a/movie.mp4" → "a/movie.part.mp4": programs take the format from the extension.
std::filesystem::path unfinished(const std::filesystem::path& file);

/// Runs `maker`, which writes unfinished(file), and renames the complete file to its final name. Returns exit_fine or
/// the code of an interrupt. Throws OutputError if the program is missing or fails; no file remains then.
int make_file(const Maker& maker, const std::vector<std::string>& arguments,
              const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace taut::cli
