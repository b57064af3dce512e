#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace taut::cli {

/// What the program tells the shell; scripts rely on these numbers.
enum ExitCode : int {
  exit_fine = 0,           // a verdict is a result, not an error
  exit_different = 1,      // `diff`, `snapshot`, `check`: pictures or numbers differ
  exit_not_granted = 1,    // `choose`: no run that is stored grants the wish
  exit_bug = 1,            // an error that is nobody's but ours
  exit_wrong_input = 2,    // the command line or a scene is wrong
  exit_diverged = 3,       // the simulation diverged, or its verdict is one that --fail-on names
  exit_not_written = 4,    // output could not be written
  exit_interrupted = 130,  // 128 + SIGINT, as shells have it
};

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
