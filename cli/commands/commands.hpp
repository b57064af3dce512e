#pragma once

#include <span>

#include "cli/command_line/command.hpp"

namespace taut::cli {

/// All commands, in the order of `taut --help`.
std::span<const Command> commands();

}  // namespace taut::cli
