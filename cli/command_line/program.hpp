#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/command_line/command.hpp"

namespace taut::cli {

/// The program `taut` with these commands: reads the arguments (without the program's own name), runs the
/// command and returns the exit code. Every error ends here as a message on `streams.err`.
int run_program(std::span<const Command> commands, const std::vector<std::string>& arguments,
                Streams streams);

}  // namespace taut::cli
