#pragma once

#include <cstdlib>

#include "tests/support/program_runner.hpp"

namespace taut::test {

/// Sets PATH to one folder while alive.
class OnlyPath {
 public:
  explicit OnlyPath(const fs::path& folder) : old_(std::getenv("PATH")) {
    ::setenv("PATH", folder.c_str(), 1);
  }
  ~OnlyPath() { ::setenv("PATH", old_.c_str(), 1); }
  OnlyPath(const OnlyPath&) = delete;
  OnlyPath& operator=(const OnlyPath&) = delete;

 private:
  std::string old_;
};

}  // namespace taut::test
