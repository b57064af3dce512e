#pragma once

#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "cli/session/session.hpp"

namespace taut::cli {

struct Dialogue {
  std::ostream& out;
  const Interrupts& interrupts;
  Progress& progress;
};

struct SessionCommand {
  std::string name;
  std::string arguments;
  std::string help;
  /// `words` exclude the name.
  std::function<void(Session& session, const std::vector<std::string>& words, const Dialogue& to)> run;
};

/// In the order of `help`.
std::span<const SessionCommand> session_commands();

/// Returns false for `quit`. Ignores empty lines and comments (#). Throws UsageError for a wrong line.
bool run_session_line(Session& session, const std::string& line, const Dialogue& to);

}  // namespace taut::cli
