#pragma once

#include <functional>
#include <string_view>

#include "cli/system/streams.hpp"

namespace taut::cli {

class Options;

/// One command of the program: `taut NAME ...`.
struct Command {
  std::string_view name;
  std::string_view summary;
  std::string_view examples;  // whole lines, shown at the end of --help
  /// Declares the command's options; what it returns runs once they have been read, and gives the exit code.
  std::function<int(Streams)> (*declare)(Options& options);
};

}  // namespace taut::cli
