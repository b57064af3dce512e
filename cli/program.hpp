#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace taut {

/// The program `taut`: reads the arguments (without the program's own name), runs the command and returns the
/// exit code. Every error ends here as a message on `err`.
int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace taut
