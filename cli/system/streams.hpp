#pragma once

#include <iosfwd>

namespace taut::cli {

/// Results go to `out`; progress, warnings and errors to `err`.
struct Streams {
  std::ostream& out;
  std::ostream& err;
};

}  // namespace taut::cli
