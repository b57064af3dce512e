#pragma once

#include <string>
#include <vector>

#include "cli/command_line/placeholders.hpp"
#include "cli/session/session.hpp"

namespace taut::cli {

/// What the last of `words`, a line of a session as far as it is typed, can become: as `help` has the
/// commands and their arguments.
Choices session_choices(const Session& session, const std::vector<std::string>& words);

}  // namespace taut::cli
