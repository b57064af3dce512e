#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/scene/scene_file.hpp"

namespace taut::cli {

/// What can be typed in one place.
struct Choices {
  std::vector<std::string> words;
  // files that fit as well, as a pattern: "*.toml", with the folders on the way; "*/": folders; empty: none
  std::string files;
};

/// What can stand where the help has `placeholder`, with `typed` there so far: FIELD is one of the fields,
/// "FIELD,..." a list of them, "LOW:HIGH|auto" may be auto, "panel.png" is a PNG file. A number has no
/// choices. `scene` has the names that a scene brings along; nullptr: it is not known.
Choices choices(std::string_view placeholder, const std::string& typed, const SceneFile* scene);

}  // namespace taut::cli
