#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace taut::cli {

/// Exit codes of the program. Scripts rely on these numbers.
enum ExitCode : int {
  exit_fine = 0,         // a verdict is a result, not an error
  exit_different = 1,    // `diff`, `snapshot`, `check`: pictures or numbers differ
  exit_not_granted = 1,  // `choose`: no stored run satisfies the request
  exit_wrong_input = 2,  // the command line or a scene is wrong
  exit_diverged = 3,     // the simulation diverged, or its verdict is as bad as --fail-on or worse
  exit_not_written = 4,  // output could not be written
  exit_bug = 70,         // an error of taut itself; EX_SOFTWARE of sysexits.h
};

/// 128 + `signal`, as shells report a program that a signal ended.
constexpr int exit_by_signal(int signal) { return 128 + signal; }

/// What users are told of an error, and its exit code.
struct Failure {
  std::string message;
  int code;
};
/// Of the exception that is being handled, whatever it is.
Failure current_failure();

/// The exit code of `action`: its own, or that of the error it throws, which ends as a message on `err`.
int guarded(const std::function<int()>& action, std::ostream& err);

}  // namespace taut::cli
