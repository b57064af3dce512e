#pragma once

#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "cli/session/session.hpp"

namespace taut::cli {

/// Environment of a session command.
struct Dialogue {
  std::ostream& out;  // for answers
  const Interrupts& interrupts;
  Progress& progress;
};

struct SessionCommand {
  std::string name;
  std::string arguments;  // for `help`
  std::string help;
  /// `words`: arguments.
  std::function<void(Session& session, const std::vector<std::string>& words, const Dialogue& to)> run;
};

/// In the order of `help`, including drawing keys.
std::span<const SessionCommand> session_commands();

/// Runs one line; false for `quit`. Ignores empty lines and comments (#). Throws UsageError.
bool run_session_line(Session& session, const std::string& line, const Dialogue& to);

}  // namespace taut::cli
