#pragma once

#include <string>
#include <vector>

#include "cli/command_line/placeholders.hpp"
#include "cli/session/session.hpp"

namespace taut::cli {

/// All choices in place of the last word of a partial line; typed letters of this word do not limit them.
Choices session_choices(const Session& session, const std::vector<std::string>& words);

}  // namespace taut::cli
