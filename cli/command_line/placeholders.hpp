#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/scene/scene_file.hpp"

namespace taut::cli {

struct Choices {
  std::vector<std::string> words;
  // pattern of files that also fit: "*.toml" (and folders), "*/" (folders only) or ""
  std::string files;
};

/// Completes `typed` for a placeholder such as "FIELD,..." or "LOW:HIGH|auto". `scene` may be nullptr.
Choices choices(std::string_view placeholder, const std::string& typed, const SceneFile* scene);

}  // namespace taut::cli
