#pragma once

#include <functional>
#include <iosfwd>
#include <span>
#include <string>
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
  std::string name;
  std::string arguments;  // as help shows them
  std::string help;
  /// `words` are what stands behind the name.
  std::function<void(Session& session, const std::vector<std::string>& words, const Dialogue& to)> run;
};

/// Every command, in the order in which `help` lists them; those of the keys of drawing are among them.
std::span<const SessionCommand> session_commands();

/// Runs one line. False if it says that the session is over. An empty line, or one that begins with #, is no
/// command. Throws UsageError for a line that is wrong.
bool run_session_line(Session& session, const std::string& line, const Dialogue& to);

}  // namespace taut::cli
