#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/session/session.hpp"

namespace taut::cli {

/// What a line of a session works with besides the session.
struct Dialogue {
  std::ostream& out;  // for answers
  const Interrupts& interrupts;
  Progress& progress;
};

/// One command of `taut session`.
struct SessionCommand {
  std::string_view name;
  std::string_view arguments;  // as help shows them
  std::string_view help;
  /// `words` are what stands behind the name.
  void (*run)(Session& session, const std::vector<std::string>& words, const Dialogue& to);
};

/// Every command, in the order in which `help` lists them.
std::span<const SessionCommand> session_commands();

/// Runs one line. False if it says that the session is over. An empty line, or one that begins with #, is no
/// command. Throws UsageError for a line that is wrong.
bool run_session_line(Session& session, const std::string& line, const Dialogue& to);

}  // namespace taut::cli
