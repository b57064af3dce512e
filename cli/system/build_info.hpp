#pragma once

#include <span>
#include <string_view>

namespace taut::cli {

struct Library {
  std::string_view name, version;
};

/// From cli/build_info.cmake.
struct BuildInfo {
  std::string_view version;   // "0.2.0"
  std::string_view commit;    // 12 digits, and "-dirty" after local changes; or "unknown"
  std::string_view compiler;  // "GNU 12.2.0"
  std::span<const Library> libraries;
};
extern const BuildInfo build_info;

}  // namespace taut::cli
