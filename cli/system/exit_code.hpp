#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace taut::cli {

/// Scripts rely on these numbers.
enum ExitCode : int {
  exit_fine = 0,         // with any verdict but `diverged`
  exit_different = 1,    // `diff`, `snapshot`, `check`
  exit_not_granted = 1,  // `choose`: no stored run qualifies
  exit_wrong_input = 2,
  exit_diverged = 3,  // also for a verdict as bad as --fail-on
  exit_not_written = 4,
  exit_bug = 70,  // EX_SOFTWARE of sysexits.h
};

/// Exit code after a signal, as in shells.
constexpr int exit_by_signal(int signal) { return 128 + signal; }

struct Failure {
  std::string message;
  int code;
};
/// Describes the exception being handled.
Failure current_failure();

/// Returns the exit code of `action`. Prints an exception to `err` and returns its code.
int guarded(const std::function<int()>& action, std::ostream& err);

}  // namespace taut::cli
