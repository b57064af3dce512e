#pragma once

#include <string>
#include <vector>

#include "cli/command_line/placeholders.hpp"
#include "cli/session/session.hpp"

namespace taut::cli {

/// Choices for the last word of a partial line, also those that begin differently.
Choices session_choices(const Session& session, const std::vector<std::string>& words);

}  // namespace taut::cli
