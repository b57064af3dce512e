#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/command_line/command.hpp"

namespace taut::cli {

/// Runs `taut`; `arguments` exclude its name. Returns the exit code and reports all errors on `streams.err`.
int run_program(std::span<const Command> commands, const std::vector<std::string>& arguments,
                Streams streams);

}  // namespace taut::cli
