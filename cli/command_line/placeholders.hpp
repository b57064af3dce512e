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

/// Choices for a placeholder of --help: FIELD, a list "FIELD,...", "LOW:HIGH|auto" or "panel.png". Numbers have none.
/// `scene` adds names of the scene; nullptr if unknown.
Choices choices(std::string_view placeholder, const std::string& typed, const SceneFile* scene);

}  // namespace taut::cli
