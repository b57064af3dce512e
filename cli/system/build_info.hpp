#pragma once

#include <span>
#include <string_view>

namespace taut::cli {

struct Library {
  std::string_view name, version;
};

struct BuildInfo {
  std::string_view version;
  std::string_view commit;  // 12 digits, "-dirty" with changes; "unknown" without git
  std::string_view compiler;
  std::span<const Library> libraries;
};
extern const BuildInfo build_info;

}  // namespace taut::cli
