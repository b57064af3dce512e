#pragma once

namespace taut::cli {

/// Where something stands in a file, 1-based; 0 = unknown.
struct FilePlace {
  int line = 0, column = 0;
};

}  // namespace taut::cli
