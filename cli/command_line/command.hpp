#pragma once

#include <functional>
#include <string_view>

#include "cli/system/streams.hpp"

namespace taut::cli {

class Options;

struct Command {
  std::string_view name;
  std::string_view summary;
  std::string_view examples;  // whole lines, for the end of --help
  /// Declares options; the returned function runs after they were read and returns the exit code.
  std::function<int(Streams)> (*declare)(Options& options);
};

}  // namespace taut::cli
