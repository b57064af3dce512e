#pragma once

#include <span>

#include "cli/command_line/command.hpp"

namespace taut::cli {

std::span<const Command> commands();

}  // namespace taut::cli
