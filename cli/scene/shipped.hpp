#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace taut::cli {

/// The folder of the scenes that come with taut.
std::filesystem::path scenes_folder();
/// Names of the scenes there, sorted.
std::vector<std::string> scene_names();
/// `scene` is a path or a name; throws UsageError with the nearest names.
std::filesystem::path find_scene(const std::string& scene);

/// Names of the sweep files in scenes/studies/, sorted.
std::vector<std::string> study_names();
/// `sweep` is a path or the name of one of them; throws UsageError with the nearest names.
std::filesystem::path find_sweep(const std::string& sweep);

}  // namespace taut::cli
