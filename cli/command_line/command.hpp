#pragma once

#include <functional>
#include <string_view>

#include "cli/system/streams.hpp"

namespace CLI {
class App;
}

namespace taut::cli {

/// One command of the program: `taut NAME ...`.
struct Command {
  std::string_view name;
  std::string_view summary;
  std::string_view examples;  // whole lines, shown at the end of --help
  /// Declares the command's options; what it returns runs once they have been read, and gives the exit code.
  std::function<int(Streams)> (*declare)(CLI::App& options);
};

}  // namespace taut::cli
