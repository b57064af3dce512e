#pragma once

#include <span>

#include "cli/command_line/command.hpp"

namespace taut::cli {

/// In the order of `taut --help`.
std::span<const Command> commands();

}  // namespace taut::cli
