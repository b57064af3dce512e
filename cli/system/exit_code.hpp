#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace taut::cli {

/// Scripts rely on these numbers.
enum ExitCode : int {
  exit_fine = 0,
  exit_different = 1,    // `diff`, `snapshot`, `check`, `claims`
  exit_not_granted = 1,  // `choose`
  exit_wrong_input = 2,
  exit_diverged = 3,  // or the verdict is at least as bad as --fail-on
  exit_not_written = 4,
  exit_bug = 70,  // EX_SOFTWARE of sysexits.h
};

constexpr int exit_by_signal(int signal) { return 128 + signal; }

struct Failure {
  std::string message;
  int code;
};
Failure current_failure();

/// Returns the exit code. Prints exceptions to `err`.
int guarded(const std::function<int()>& action, std::ostream& err);

}  // namespace taut::cli
