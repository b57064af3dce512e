#pragma once

#include <string>
#include <vector>

#include "cli/command_line/placeholders.hpp"
#include "cli/session/session.hpp"

namespace taut::cli {

/// Completes the last of `words`, a partial line of a session, with commands and arguments as `help` lists them.
Choices session_choices(const Session& session, const std::vector<std::string>& words);

}  // namespace taut::cli
