#pragma once

#include <span>

#include "cli/command_line/command.hpp"

namespace taut::cli {

/// Every command, in the order in which `taut --help` lists them.
std::span<const Command> commands();

}  // namespace taut::cli
