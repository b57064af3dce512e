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

/// For placeholders such as FIELD, "FIELD,...", "LOW:HIGH|auto" and "panel.png"; `scene` adds its names, if known.
Choices choices(std::string_view placeholder, const std::string& typed, const SceneFile* scene);

}  // namespace taut::cli
