#pragma once

#include <functional>
#include <iosfwd>
#include <span>
#include <string_view>

namespace CLI {
class App;
}

namespace taut {

/// Where a command prints: results to `out`; progress, warnings and errors to `err`.
struct Streams {
  std::ostream& out;
  std::ostream& err;
};

/// One command of the program: `taut NAME ...`.
struct Command {
  std::string_view name;
  std::string_view summary;
  std::string_view examples;  // whole lines, shown at the end of --help
  /// Declares the command's options; what it returns runs once they have been read, and gives the exit code.
  std::function<int(Streams)> (*declare)(CLI::App& options);
};

/// Every command, in the order in which `taut --help` lists them.
std::span<const Command> commands();

}  // namespace taut
