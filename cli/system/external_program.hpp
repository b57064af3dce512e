#pragma once

#include <filesystem>
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

/// Runs a program, found by its name in PATH, in `folder`, without a shell: no argument has a special
/// meaning. Its stdin and stdout are empty. An interrupt ends it.
ProcessResult run_process(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                          const Interrupts& interrupts);

}  // namespace taut::cli
