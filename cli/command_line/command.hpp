#pragma once

#include <functional>
#include <string_view>

#include "cli/system/streams.hpp"

namespace taut::cli {

class Options;

struct Command {
  std::string_view name;
  std::string_view summary;
  std::string_view examples;
  /// The returned function runs the command and returns the exit code.
  std::function<int(Streams)> (*declare)(Options& options);
};

}  // namespace taut::cli
