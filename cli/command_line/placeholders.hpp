#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/scene/scene_file.hpp"

namespace taut::cli {

struct Choices {
  std::vector<std::string> words;
  // pattern of files that also fit; "*/": only folders; "": none
  std::string files;
};

/// Candidates for a placeholder; they need not begin with `typed`. `scene` may be nullptr.
Choices choices(std::string_view placeholder, const std::string& typed, const SceneFile* scene);

}  // namespace taut::cli
