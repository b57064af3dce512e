#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/scene/scene_file.hpp"

namespace taut::cli {

struct Choices {
  std::vector<std::string> words;
  // pattern of files that also fit, such as "*.toml" (and folders); "*/": folders only; "": none
  std::string files;
};

/// Candidates for a placeholder such as "FIELD,..." or "LOW:HIGH|auto", even if they do not begin with `typed`. `scene`
/// may be nullptr.
Choices choices(std::string_view placeholder, const std::string& typed, const SceneFile* scene);

}  // namespace taut::cli
