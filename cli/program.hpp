#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace taut {

/// The program `taut`: reads the arguments (without the program's own name), runs the command and returns the
/// exit code. Every error ends here as a message on `err`.
int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

/// The exit code of `action`: its own, or that of the error it throws, which ends as a message on `err`.
int guarded(const std::function<int()>& action, std::ostream& err);

}  // namespace taut
