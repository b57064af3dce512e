#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/command_line/command.hpp"

namespace taut::cli {

/// `arguments` exclude `taut`. Returns the exit code.
int run_program(std::span<const Command> commands, const std::vector<std::string>& arguments,
                Streams streams);

}  // namespace taut::cli
