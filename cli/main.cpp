#include <iostream>

#include "cli/command_line/program.hpp"
#include "cli/commands/commands.hpp"

int main(int argc, char** argv) {
  return taut::cli::run_program(taut::cli::commands(), {argv + 1, argv + argc}, {std::cout, std::cerr});
}
