#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace taut::cli {

/// Exit codes of taut. Scripts rely on these numbers.
enum ExitCode : int {
  exit_fine = 0,         // a verdict is a result, not an error
  exit_different = 1,    // `diff`, `snapshot`, `check`: pictures or numbers differ
  exit_not_granted = 1,  // `choose`: no stored run qualifies
  exit_wrong_input = 2,  // the command line or a scene is wrong
  exit_diverged = 3,     // the simulation diverged, or its verdict is at least as bad as --fail-on
  exit_not_written = 4,  // output could not be written
  exit_bug = 70,         // an error of taut itself; EX_SOFTWARE of sysexits.h
};

/// Exit code of a program that a signal ended, as shells report it.
constexpr int exit_by_signal(int signal) { return 128 + signal; }

/// Message to the user and exit code of an error.
struct Failure {
  std::string message;
  int code;
};
/// Describes the exception that is being handled, of whatever type.
Failure current_failure();

/// Returns the exit code of `action`. Prints an exception to `err` and returns its code.
int guarded(const std::function<int()>& action, std::ostream& err);

}  // namespace taut::cli
