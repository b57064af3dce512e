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

/// Completions for a placeholder such as FIELD, "FIELD,...", "LOW:HIGH|auto" or "panel.png", after the partial word
/// `typed`. `scene` adds its names; nullptr if it is unknown.
Choices choices(std::string_view placeholder, const std::string& typed, const SceneFile* scene);

}  // namespace taut::cli
